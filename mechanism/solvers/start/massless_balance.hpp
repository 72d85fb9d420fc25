// Directions without mass at the start of a motion (and after a jump of forces): a node between two springs, say.
//
// They have no inertia. Where nothing damps them they are in the equilibrium of their forces, given
// where all that has mass is,
//     r_s(q_s, q_m, v, a_m, lambda, t) = 0,
// and their velocities keep it. Where a damper acts on them, their positions are as given and their velocities are
// those that balance their forces. Started otherwise, they would get there within the first step, by velocities of the
// order of the distance over h.
#pragma once

#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// @param state   with consistent positions and velocities; accelerations and multipliers are renewed
/// @param report  receives how far what moved, and a node whose forces could not be balanced
/// @throws ComputationError naming an unknown that has no mass and that nothing holds
void balance_massless(const System& system, const Environment& environment, State& state, StartReport& report);

}  // namespace bielle::mechanism
