// Sparse algebra for matrices that may be neither symmetric nor definite: symmetric parts, factors, extreme eigenpairs.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "reduce/matrices/matrix_set.hpp"
#include "reduce/sparse/factor.hpp"

namespace bielle::reduce {

using Unknowns = std::vector<Eigen::Index>;

/// (A + A^T) / 2
SparseColumns symmetric_part(const SparseColumns& A);

/// Returns the rows and columns of some unknowns, in their order.
SparseColumns submatrix(const SparseColumns& A, const Unknowns& rows, const Unknowns& columns);

/// Factor of a symmetric positive definite matrix, of which the lower triangle is read.
/// @throws NotPositiveDefinite; ComputationError when memory does not suffice
std::unique_ptr<Factor> definite_factor(const SparseColumns& A, int threads);

/// The least eigenvalue of D A D, D = |diag A|^-1/2, so that it does not depend on the units of the unknowns.
struct LeastEigenvalue {
  double value = 0;
  Eigen::Index unknown = 0;  ///< unknown with the largest part in its eigenvector
};

/// @param A  symmetric; unknowns with a zero diagonal entry count with a factor of 1 in D if they have other entries,
/// and are left out otherwise
/// @returns nothing if the matrix is empty
std::optional<LeastEigenvalue> least_scaled_eigenvalue(const SparseColumns& A, int threads);

/// Natural modes of K and M, M positive semidefinite.
struct NaturalModes {
  Eigen::VectorXd eigenvalues;  ///< omega^2, ascending; those of rigid motions are near zero and may be negative
  Eigen::MatrixXd vectors;      ///< (n, modes) phi^T M phi = 1
};

/// Returns the lowest modes of a body that may be free.
/// @param count  at most so many are computed
/// @param shift  about the first elastic omega^2, or 0 for a body that is held: K + shift M is factorised
/// @throws NotPositiveDefinite if K + shift M is not definite; ComputationError if modes do not converge
NaturalModes natural_modes(const SparseColumns& K, const SparseColumns& M, int count, double shift, int threads);

/// Frequency of an eigenvalue [Hz]; negative for a negative one.
double signed_frequency(double eigenvalue);

/// C with A C nearest to B in least squares. @param A  (n,k) few columns of full rank
Eigen::MatrixXd few_least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace bielle::reduce
