// Eigenvalues of dense matrices that are not symmetric. Eigen's solver is a heavy template: it is compiled here only.
#pragma once

#include <Eigen/Core>

namespace bielle::test {

/// Returns all eigenvalues, in no particular order.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);

}  // namespace bielle::test
