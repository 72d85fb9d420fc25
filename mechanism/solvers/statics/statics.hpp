// Static equilibrium by load steps: loads, gravity and prescribed motions grow with the load factor to their full
// value. For paths past limit points of the load see arc_length.hpp.
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
  /// 0: a tenth of the interval is tried first, and increments grow as long as Newton's method converges fast.
  int count = 1;
  Loaded start{};  ///< fractions already applied
  /// If the stiffness becomes negative, the branch at this point is followed: by a temporary force that deflects it
  /// along the critical motion by this fraction of the mechanism's size, or in radians. 0: the path continues,
  /// unstable.
  double branch = 0;
  std::vector<double> stops;              ///< load factors at which an increment must end, ascending
  std::vector<CoordinateCondition> held;  ///< coordinates that are kept at their values
  LoadSteps(int steps, const Loaded& begin = {}) : count(steps), start(begin) {}
};

/// An increment that led to another equilibrium, because the path of the first one ends within it.
struct LoadJump {
  double factor = 0;    ///< load factor
  std::string node;     ///< node with the largest sudden movement
  double distance = 0;  ///< [m]
};

/// Cost of the increments of the load factor, and the stability found.
struct StaticsLog {
  std::vector<CriticalPoint> critical;
  std::optional<int> unstable;  ///< number of motions of negative stiffness at the end; no value: not known
  std::string why_not_known;    ///< reason as a clause, if the stability at the end is not known
  std::vector<LoadJump> jumps;
  std::string fell;         ///< part without support against its load that moved to another rest position; empty: none
  std::string loose;        ///< unknown without support or load at the end, which keeps its initial value; empty: none
  long solves = 0;          ///< number of linear solutions, including those of rejected increments
  long refused = 0;         ///< number of increments that did not converge
  double refused_at = 0;    ///< load factor at the end of the last rejected increment
  std::string why_refused;  ///< reason of the last one
};

/// Brings the state to equilibrium under the full load in increments of the load factor, each by Newton's method; an
/// increment that does not converge is halved (down to 1/1024 of the first). Later ones grow again, up to the next
/// point of the requested grid. Velocities and accelerations are zero. If all of the load acts already (after a
/// motion), there is one step, from the present state to equilibrium.
/// @param environment  with gravity of load factor 1
/// @param record       called after each increment with the state, its load factor and the iterations
/// @throws ComputationError naming the load factor and the component that could not be evaluated, or the equation at
/// which Newton's method stalled
StaticsLog solve_statics(const System& system, const Environment& environment, const LoadSteps& steps,
                         const NewtonOptions& options, State& state,
                         const std::function<void(const State&, double, int)>& record = {});

/// Brings the state to equilibrium under the loads at its time, as the start of a motion: velocities are not changed.
/// Adds the movements by assembly and by equilibrium to the report.
/// @param held  coordinates that are kept at their values, for any load
/// @throws ComputationError if there is no equilibrium nearby, or if the mechanism can move without resistance in it
void settle(const System& system, const Environment& environment, const NewtonOptions& options,
            const std::vector<CoordinateCondition>& held, State& state, StartReport& report);

}  // namespace bielle::mechanism
