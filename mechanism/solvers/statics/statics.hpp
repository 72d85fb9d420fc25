// Static equilibrium by load steps: loads, gravity and prescribed motions grow with the load factor to their full
// value. Past limit points of the load: arc_length.hpp.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/solvers/newton/convergence.hpp"
#include "mechanism/solvers/start/start_conditions.hpp"
#include "mechanism/solvers/start/start_report.hpp"
#include "mechanism/solvers/statics/critical_point.hpp"
#include "mechanism/solvers/statics/load_ramp.hpp"

namespace bielle::mechanism {

/// Equal increments of the load factor.
struct LoadSteps {
  /// 0: a tenth of the way is tried first, and increments grow as long as Newton's method converges fast.
  int count = 1;
  Loaded start{};  ///< what acts already
  /// Where the stiffness becomes negative the branch is followed that leaves there: with a force on the way that
  /// deflects it along the critical motion by this much of the mechanism's size, or in radians. 0: the path goes on,
  /// unstable.
  double branch = 0;
  std::vector<double> stops;              ///< load factors at which an increment ends in any case, ascending
  std::vector<CoordinateCondition> held;  ///< coordinates that stay where their values say
  LoadSteps(int steps, const Loaded& begin = {}) : count(steps), start(begin) {}
};

/// An increment that led to another equilibrium than the one it came from, because that one ends on the way.
struct LoadJump {
  double factor = 0;    ///< where
  std::string node;     ///< that moves farthest at once
  double distance = 0;  ///< [m]
};

/// What increments of the load factor cost, and what stability was found.
struct StaticsLog {
  std::vector<CriticalPoint> critical;
  std::optional<int> unstable;  ///< motions of negative stiffness at the end; none: not known
  std::vector<LoadJump> jumps;
  std::string fell;         ///< what nothing held against its load, until it rested elsewhere; empty: nothing
  std::string loose;        ///< what nothing holds or loads at the end, and stays as drawn; empty: nothing
  long solves = 0;          ///< linear solves, those of refused increments included
  long refused = 0;         ///< increments that did not converge
  double refused_at = 0;    ///< the load factor where the last one should have led
  std::string why_refused;  ///< of the last one
};

/// Brings the state into equilibrium under the full load in increments of the load factor, each by Newton's method; an
/// increment that does not converge is halved (down to 1/1024 of the first). Later ones grow again, up to the next
/// point of the grid that was asked for. Velocities and accelerations are zero. Where all of the load acts already
/// (after a motion), there is one step, from the present state to equilibrium.
/// @param environment  with gravity of load factor 1
/// @param record       called after each increment with the state, its load factor and the iterations
/// @throws ComputationError naming the load factor and what refused, or the equation where Newton stalled
StaticsLog solve_statics(const System& system, const Environment& environment, const LoadSteps& steps,
                         const NewtonOptions& options, State& state,
                         const std::function<void(const State&, double, int)>& record = {});

/// Brings the state into equilibrium under the loads at its time, as the start of a motion: velocities stay as they
/// are. Adds to the report what had to move, by assembly and by equilibrium.
/// @param held  coordinates that stay where their values say, whatever loads them
/// @throws ComputationError when there is no equilibrium near, or when the mechanism can move without resistance in it
void settle(const System& system, const Environment& environment, const NewtonOptions& options,
            const std::vector<CoordinateCondition>& held, State& state, StartReport& report);

}  // namespace bielle::mechanism
