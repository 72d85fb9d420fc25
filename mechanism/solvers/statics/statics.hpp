// Static equilibrium by load steps: loads, gravity and prescribed motions grow with the load factor to their full
// value. Past limit points of the load: arc_length.hpp.
#pragma once

#include <functional>

#include "mechanism/solvers/newton/convergence.hpp"
#include "mechanism/solvers/start/start_report.hpp"
#include "mechanism/solvers/statics/load_ramp.hpp"

namespace bielle::mechanism {

/// Equal increments of the load factor.
struct LoadSteps {
  /// 0: a tenth of the way is tried first, and increments grow as long as Newton's method converges fast.
  int count = 1;
  Loaded start{};  ///< what acts already
  LoadSteps(int steps, const Loaded& begin = {}) : count(steps), start(begin) {}
};

/// Brings the state into equilibrium under the full load in increments of the load factor, each by Newton's method; an
/// increment that does not converge is halved (down to 1/1024 of the first). Velocities and accelerations are zero.
/// Where all of the load acts already (after a motion), there is one step, from the present state to equilibrium.
/// @param environment  with gravity of load factor 1
/// @param record       called after each increment with the state, its load factor and the iterations
/// @throws ComputationError naming the load factor and what refused, or the equation where Newton stalled
void solve_statics(const System& system, const Environment& environment, const LoadSteps& steps,
                   const NewtonOptions& options, State& state,
                   const std::function<void(const State&, double, int)>& record = {});

/// Brings the state into equilibrium under the loads at its time, as the start of a motion: velocities stay as they
/// are. Adds to the report what had to move, by assembly and by equilibrium.
/// @throws ComputationError when there is no equilibrium near, or when the mechanism can move without resistance in it
void settle(const System& system, const Environment& environment, const NewtonOptions& options, State& state,
            StartReport& report);

}  // namespace bielle::mechanism
