// Directions without mass at the start of a motion (and after a jump of forces), for example of a node between two
// springs.
//
// They have no inertia. If they have no damping, they are in the equilibrium of their forces, for given positions of
// the dofs with mass,
//     r_s(q_s, q_m, v, a_m, lambda, t) = 0,
// and their velocities maintain it. If a damper acts on them, their positions are as given and their velocities are
// those that balance their forces. With other start values, they would reach this state within the first step, with
// velocities of the order of the distance divided by h.
#pragma once

#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// @param state   state with consistent positions and velocities; accelerations and multipliers are recomputed
/// @param report  receives the displacements, and a node whose forces could not be balanced
/// @throws ComputationError naming an unknown that has neither mass nor a force or constraint
void balance_massless(const System& system, const Environment& environment, State& state, StartReport& report);

}  // namespace bielle::mechanism
