// Rigid motions of the body, at its points and in its interface coordinates.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reduce/sparse/symmetric_matrix.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// a~ with a~ b = a x b.
Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/// Displacements (3 points, 6) of every point by unit translations along x y z and unit rotations about axes through
/// `about`.
RowMatrix rigid_motions(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& about);

/// Returns the rigid motion of one direction (x y z rx ry rz in its own axes) of an interface.
Eigen::Matrix<double, 1, 6> interface_rigid_motion(const Interface& interface, int axis, const Eigen::Vector3d& about);

/// Returns the rigid motion of the kept directions of the interfaces: (kept directions, 6).
Eigen::MatrixXd interface_rigid_motions(const std::vector<Interface>& interfaces, const Eigen::Vector3d& about);

/// Returns the rigid motion nearest to given interface coordinates, with rotations weighted by a length: A (6, kept
/// directions) with A U = I, U the interface_rigid_motions.
Eigen::MatrixXd nearest_rigid_motion(const std::vector<Interface>& interfaces, const Eigen::Vector3d& about,
                                     double length);

}  // namespace bielle::reduce
