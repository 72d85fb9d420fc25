// The linearised equations of a mechanism with a turning part (turning_part.hpp) over one turn.
//
// The same mean state is turned to equidistant azimuths psi of the part. At each, u contains increments in axes that
// turn with the part for its nodes, and inertial ones for the others; rows of constraints are combined such that their
// entries at the turning nodes do not depend on psi. Coefficients that still depend on psi are those by which the
// standing and the turning part act on each other.
#pragma once

#include <vector>

#include "mechanism/solvers/linearised/equations.hpp"
#include "mechanism/solvers/linearised/turning_part.hpp"

namespace bielle::mechanism {

/// @param state  the mean state in steady rotation @param count  number of azimuths
/// @returns the equations at psi = 2 pi k / count; W is the same for all
/// @throws ComputationError if the turned state is no equilibrium: if some force depends on the azimuth
std::vector<LinearisedEquations> equations_over_turn(const System& system, const Environment& environment,
                                                     const State& state, const TurningPart& part, int count);

}  // namespace bielle::mechanism
