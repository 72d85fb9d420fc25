// Frequencies of the free body when shapes are added to those of the reduced one: Rayleigh and Ritz.
#pragma once

#include "reduce/reduction/adequacy.hpp"
#include "reduce/reduction/reduced_matrices.hpp"

namespace bielle::reduce {

/// All are above those of any body in whose reach both kinds of shapes are (Courant and Fischer), and none is above
/// that of the reduced body.
/// @param free    elastic modes of the reduced body
/// @param shapes  added ones (3 points, p), which may depend on each other or be of no size
/// @param count   of frequencies wanted
/// @returns omega^2, the lowest ones, ascending [rad^2/s^2]
Eigen::VectorXd enriched_eigenvalues(const FullModel& model, const Superelement& body, const FreeModes& free,
                                     const RowMatrix& shapes, Eigen::Index count);

}  // namespace bielle::reduce
