// Factors of dense symmetric matrices by LAPACK, which OpenBLAS contains.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "reduce/dense/matrix_refs.hpp"

namespace bielle {

/// A = L L^T: the lower triangle of A (n,n) becomes L, the rest is neither read nor written.
/// @returns the first column whose pivot is not positive (or no number), and A is then spoilt; nothing where all are
std::optional<Eigen::Index> factorise_definite(Eigen::MatrixXd& A);

/// Whether a symmetric matrix has a Cholesky factorisation, which one with NaN has not; its lower triangle alone is
/// read.
bool is_positive_definite(const ConstMatrixRef& A);

/// B (n,k) becomes A^-1 B. @param L  in the lower triangle, as `factorise_definite` leaves it
void solve_definite(const Eigen::MatrixXd& L, Eigen::MatrixXd& B);

/// Numbers of eigenvalues by their sign.
struct EigenvalueSigns {
  Eigen::Index negative = 0;
  Eigen::Index unknown = 0;  ///< zero to rounding, so that nothing is known of their sign; all where A is not finite
};

/// Counts the eigenvalues of a symmetric matrix by L D L^T with interchanges (Bunch and Kaufman): D has the signs of A
/// (Sylvester).
/// @param A      (n,n) its lower triangle is read, and overwritten
/// @param scale  (n) positive: an eigenvalue of S A S with S = diag(scale)^-1/2 counts as zero where rounding hides it,
///               in numbers of the size of its largest entry
EigenvalueSigns eigenvalue_signs(Eigen::MatrixXd A, const Eigen::VectorXd& scale);

}  // namespace bielle
