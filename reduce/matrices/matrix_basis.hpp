// The basis of a body of foreign matrices: constraint modes and fixed-boundary modes.
#pragma once

#include <optional>
#include <string>

#include "reduce/common/progress.hpp"
#include "reduce/matrices/held_matrices.hpp"
#include "reduce/matrices/matrix_options.hpp"

namespace bielle::reduce {

struct MatrixBasis {
  Eigen::MatrixXd shapes;       ///< T (n, kept + modes)
  Eigen::VectorXd eigenvalues;  ///< omega^2 of the modes [rad^2/s^2]
  Eigen::VectorXd residuals;    ///< relative, of the modes; empty for dense algebra
  std::string method;           ///< by which modes were found, in words; empty: there are none
  int solves = 0, sweeps = 0;   ///< as in Eigenpairs
};

/// @throws InputError if the number of modes is missing for a large body, or larger than the body allows
MatrixBasis matrix_basis(const MatrixSet& set, const NodeTies& ties, const HeldMatrices& held,
                         const MatrixOptions& options, Progress& progress, int threads);

}  // namespace bielle::reduce
