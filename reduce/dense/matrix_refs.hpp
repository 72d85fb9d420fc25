// Dense matrices as arguments of functions that are compiled once for whole matrices and blocks of any type.
#pragma once

#include <Eigen/Core>

namespace bielle {

using MatrixRef = Eigen::Ref<Eigen::MatrixXd>;
/// Whole matrices and blocks of them, stored by columns, are passed without a copy.
using ConstMatrixRef = Eigen::Ref<const Eigen::MatrixXd>;

}  // namespace bielle
