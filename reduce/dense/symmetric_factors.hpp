// Factors of dense symmetric matrices by LAPACK, which OpenBLAS contains.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "reduce/dense/matrix_refs.hpp"

namespace bielle {

/// Computes A = L L^T: L replaces the lower triangle of A (n,n), and the rest is neither read nor written.
/// @returns the first column whose pivot is not positive (or not a number), in which case A is destroyed; nothing if
/// all pivots are positive
std::optional<Eigen::Index> factorise_definite(Eigen::MatrixXd& A);

/// Tells whether a symmetric matrix has a Cholesky factorisation (one with NaN has none); only its lower triangle is
/// read.
bool is_positive_definite(const ConstMatrixRef& A);

/// Replaces B (n,k) by A^-1 B. @param L  in the lower triangle, as computed by `factorise_definite`
void solve_definite(const Eigen::MatrixXd& L, Eigen::MatrixXd& B);

/// Numbers of eigenvalues by their sign.
struct EigenvalueSigns {
  Eigen::Index negative = 0;
  Eigen::Index unknown = 0;  ///< zero to rounding, so that their sign is unknown; all eigenvalues if A is not finite
};

/// Counts the eigenvalues of a symmetric matrix by L D L^T with interchanges (Bunch and Kaufman): D has the signs of A
/// (Sylvester).
/// @param A      (n,n) its lower triangle is read, and overwritten
/// @param scale  (n) positive: an eigenvalue of S A S with S = diag(scale)^-1/2 counts as zero if it is below the
///               rounding error of numbers of the size of its largest entry
EigenvalueSigns eigenvalue_signs(Eigen::MatrixXd A, const Eigen::VectorXd& scale);

}  // namespace bielle
