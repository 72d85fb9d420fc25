// Eigenvalues and eigenvectors of dense symmetric matrices. Eigen's solver is a heavy template: it is compiled here
// only.
#pragma once

#include <optional>

#include <Eigen/Core>

namespace bielle {

struct SymmetricEigenpairs {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< one in each column, in the order of the values
};

/// A v = lambda v with v^T v = 1, A symmetric; only its lower triangle is read.
/// @throws ComputationError if no eigenvalues are found, e.g. for entries that are not finite
SymmetricEigenpairs symmetric_eigenpairs(const Eigen::MatrixXd& A);

/// A v = lambda B v with v^T B v = 1, A symmetric and B symmetric and positive definite; only their lower triangles are
/// read. The result is empty if B is not positive definite or an entry is not finite.
std::optional<SymmetricEigenpairs> symmetric_eigenpairs(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace bielle
