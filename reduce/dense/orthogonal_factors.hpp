// Applications of orthogonal factors of dense matrices: complements, least squares, null spaces. Eigen's solvers are
// heavy templates: they are compiled here only.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace bielle {

/// Q of A = Q R, square: for A (m,n) of full rank, n <= m, the first n columns span those of A, the rest their
/// orthogonal complement.
Eigen::MatrixXd orthogonal_basis(const Eigen::MatrixXd& A);

/// All columns of A in the order of column pivoting: each column has the largest part normal to the preceding ones.
std::vector<Eigen::Index> pivoted_columns(const Eigen::MatrixXd& A);

/// x that minimises |A x - b|, and among these the one with the smallest |x|; A may have any rank.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// A^+ (n,m) of A (m,n): A^+ b is the solution of `least_squares`.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& A);

/// Returns an orthonormal basis (n,k) of the null space of A (m,n), by QR with column pivoting of A^T.
/// @param dependent  a row counts as dependent if its part normal to the preceding rows is at most this share of the
/// largest
Eigen::MatrixXd null_space(const Eigen::MatrixXd& A, double dependent);

/// Right singular vectors V of A = U S V^T.
struct RightSingularVectors {
  Eigen::VectorXd values;   ///< singular values, descending: min(m,n)
  Eigen::MatrixXd vectors;  ///< V (n,n); the columns after those with a value span the rest of the null space of A
};

RightSingularVectors right_singular_vectors(const Eigen::MatrixXd& A);

}  // namespace bielle
