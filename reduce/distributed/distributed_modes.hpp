// Eigenpairs by SLEPc's Krylov-Schur method on the ranks, whose vectors are distributed. What its operator does is
// asked for here: constraints are worked into the solution, which the ranks know nothing of.
#pragma once

#include "reduce/distributed/channel.hpp"
#include "reduce/spectral/eigenpairs.hpp"

namespace bielle::reduce {

/// The `count` eigenpairs nearest to the shift, which is 0; repeated ones as often as they are there.
/// @throws ComputationError when the iteration does not converge
Eigenpairs distributed_modes(Channel& channel, const ShiftInvertProblem& problem, int count,
                             const EigenpairOptions& options);

}  // namespace bielle::reduce
