// Eigenpairs by SLEPc's Krylov-Schur method on the ranks, whose vectors are distributed. The ranks request the products
// of its operator here: the solution includes the constraints, which the ranks do not know.
#pragma once

#include "reduce/distributed/channel.hpp"
#include "reduce/spectral/eigenpairs.hpp"

namespace bielle::reduce {

/// The `count` eigenpairs nearest to the shift, which is 0; repeated ones with their multiplicity.
/// @throws ComputationError when the iteration does not converge
Eigenpairs distributed_modes(Channel& channel, const ShiftInvertProblem& problem, int count,
                             const EigenpairOptions& options);

}  // namespace bielle::reduce
