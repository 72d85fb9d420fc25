// What orthogonal factors of dense matrices are used for: complements, least squares, null spaces. Eigen's solvers are
// heavy templates: they are compiled here only.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace bielle {

/// Q of A = Q R, square: for A (m,n) of full rank, n <= m, the first n columns span those of A, the rest their
/// orthogonal complement.
Eigen::MatrixXd orthogonal_basis(const Eigen::MatrixXd& A);

/// All columns of A in the order of column pivoting: each is the one with the largest part normal to those before it.
std::vector<Eigen::Index> pivoted_columns(const Eigen::MatrixXd& A);

/// x of the least |A x - b|, and of these the one of least |x|: A may have any rank.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// A^+ (n,m) of A (m,n): A^+ b is the solution of `least_squares`.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& A);

/// An orthonormal basis (n,k) of the null space of A (m,n), by QR with column pivoting of A^T.
/// @param dependent  rows whose part normal to those before is at most this share of the largest count as dependent
Eigen::MatrixXd null_space(const Eigen::MatrixXd& A, double dependent);

/// V of A = U S V^T.
struct RightSingularVectors {
  Eigen::VectorXd values;   ///< of S, descending: min(m,n)
  Eigen::MatrixXd vectors;  ///< V (n,n); the columns after those with a value span the rest of the null space of A
};

RightSingularVectors right_singular_vectors(const Eigen::MatrixXd& A);

}  // namespace bielle
