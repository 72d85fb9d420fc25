// Short names for the fixed-size vectors and matrices used in mechanics.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>  // for cross products

namespace bielle::mechanism {

using Vector2 = Eigen::Vector2d;
using Matrix2 = Eigen::Matrix2d;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using VectorX = Eigen::VectorXd;
using MatrixX = Eigen::MatrixXd;

}  // namespace bielle::mechanism
