// Residual vectors from static answers: combinations of answers and modes that are orthonormal in K and M among
// themselves and to the modes (residual_vectors.hpp).
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle::reduce {

/// Energies below this share of the whole answer's count as zero, and so do directions in which all vectors together
/// have less. It corresponds to displacements of 1e-5, far above the rounding of solutions and far below the accuracy
/// that a load needs.
inline constexpr double negligible_energy = 1e-10;

/// Products with the stiffness and the mass of a body, for blocks of fields.
struct BodyProducts {
  std::function<RowMatrix(const RowMatrix&u)> stiffness, mass;
};

/// fields = answers * of_answers - modes * of_modes
struct ResidualCombination {
  RowMatrix fields;             ///< (rows, r) v^T M v = 1, ascending eigenvalues
  Eigen::MatrixXd of_answers;   ///< (k, r)
  Eigen::MatrixXd of_modes;     ///< (modes, r)
  Eigen::VectorXd eigenvalues;  ///< omega^2 (r)
  std::vector<bool> is_left;    ///< (k) of each answer, whether the modes lack a part of it
};

/// @param answers         (rows, k) static answers of the held body
/// @param modes           (rows, modes) mass-normalised
/// @param least_energies  (k) twice the energy that an answer is compared with if its own is less
/// @throws ComputationError if the vectors have no positive mass and stiffness
ResidualCombination combine_residuals(const RowMatrix& answers, const RowMatrix& modes,
                                      const Eigen::VectorXd& least_energies, const BodyProducts& body);

}  // namespace bielle::reduce
