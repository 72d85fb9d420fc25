// The distance of two matrices.
#pragma once

#include <Eigen/Core>

namespace bielle::test {

/// Returns the largest difference of two entries.
inline double error(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return (A - B).cwiseAbs().maxCoeff(); }

}  // namespace bielle::test
