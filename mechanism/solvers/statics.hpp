// Static equilibrium by load steps: loads, gravity and prescribed joint motions grow with the load factor from 0 to 1.
#pragma once

#include <functional>

#include "mechanism/solvers/consistent_start.hpp"

namespace bielle::mechanism {

/// Brings the state into equilibrium under the full load in equal increments of the load factor, each by Newton's
/// method; an increment that does not converge is halved (down to 1/1024 of the first). Velocities and accelerations
/// are zero.
/// @param environment  with gravity of load factor 1
/// @param record       called after each increment with the state and its load factor
/// @throws ComputationError naming the load factor and the equation where Newton stalled
void solve_statics(const System& system, const Environment& environment, int steps, const NewtonOptions& options,
                   State& state, const std::function<void(const State&, double, int)>& record = {});

/// Brings the state into equilibrium under the loads at its time, as the start of a motion: velocities stay as they
/// are. Adds to the report what had to move, by assembly and by equilibrium.
/// @throws ComputationError when there is no equilibrium near, or when the mechanism can move without resistance in it
void settle(const System& system, const Environment& environment, const NewtonOptions& options, State& state,
            StartReport& report);

}  // namespace bielle::mechanism
