// Two sets of matrices of the same body, such as a full one and its reduction, side by side.
#pragma once

#include "reduce/matrices/verification.hpp"

namespace bielle::reduce {

/// Mass properties, and free modes: their frequencies, their shapes at common places (modal assurance criterion, MAC),
/// and their orthogonality in the mass of the other (phi_a^T M_b phi_b), if all unknowns of one have a counterpart.
/// Nodes and points of shapes are common if they are at the same place; among several at one place the number decides.
/// @throws ComputationError when memory does not suffice
VerifiedSubject compare(MatrixSet a, MatrixSet b, int threads = 1);

}  // namespace bielle::reduce
