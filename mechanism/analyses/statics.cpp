// Start of statics, the recorded points, and their reports.
#include "mechanism/analyses/statics.hpp"

#include <algorithm>
#include <functional>
#include <set>

#include <fmt/format.h>

#include "mechanism/session/computation.hpp"
#include "mechanism/solvers/constraints/sought_efforts.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/statics/held_states.hpp"
#include "mechanism/solvers/statics/static_tangent.hpp"

namespace bielle::mechanism {
namespace {

struct Stopped {};

/// An equilibrium before the whole load is reached.
struct StaticPoint {
  double factor;   ///< load factor
  int iterations;  ///< iterations that led to it
  double done;     ///< completed fraction of the analysis
  bool limit;      ///< it is a limit point of the load
};

using UsePoint = std::function<void(const State& state, const StaticPoint& point)>;

void note_dropped_rates(const System& system, const StartConditions& conditions, Computation& computation) {
  VectorX v(system.dofs()), unused(system.dofs());
  system.get_rates(computation.state(), v, unused);
  const bool any_rate = std::any_of(conditions.coordinates.begin(), conditions.coordinates.end(),
                                    [](const CoordinateCondition& each) { return each.rate.value_or(0) != 0; });
  if (!v.isZero(0) || any_rate)
    computation.note(
        "a static analysis is at rest, and so is what comes after it: the velocities are dropped (a dynamic "
        "analysis with `start: equilibrium` keeps them)");
}

void show_point(const Session& session, const State& state, const StaticPoint& point, bool recorded,
                Computation& computation) {
  Environment acting = session.environment();
  acting.statics = true;
  acting.load_factor = point.factor;
  acting.gravity *= point.factor;
  StepRecord report;
  report.energy = session.system().energy(state, acting);
  report.energy.input = report.energy.dissipation = 0;  // statics have no rates, and therefore no power to integrate
  report.newton_iterations = point.iterations;
  report.time = point.factor;
  computation.show(state, acting, report, recorded);
}

/// Computes the points one after the other, by load steps or along a path. @param statics  environment of statics under
/// the whole load
void follow_loads(const Session& session, const StaticsOptions& options, const Environment& statics,
                  Computation& computation, StaticsReport& report, const UsePoint& use) {
  const System& system = session.system();
  const Loaded begin = session.loaded();
  if (options.path) {
    ContinuationOptions path = *options.path;
    path.stops = session.recording().load_factors;
    computation.loaded() = follow_by_continuation(system, statics, begin, path, options.newton, computation.state(),
                                                  [&](const State& state, const PathPoint& at) {
                                                    if (at.limit) report.limit_points.push_back(at.load_factor);
                                                    if (at.bifurcation) report.log.critical.push_back(*at.bifurcation);
                                                    report.log.unstable = at.unstable;
                                                    use(state, {at.load_factor, at.iterations, at.done, at.limit});
                                                  });
    return;
  }
  LoadSteps steps(options.steps, begin);
  steps.branch = options.branch;
  steps.stops = session.recording().load_factors;
  report.log = solve_statics(system, statics, steps, options.newton, computation.state(),
                             [&](const State& state, double factor, int iterations) {
                               const double way = 1 - begin.factor;
                               use(state, {factor, iterations, way == 0 ? 1 : (factor - begin.factor) / way, false});
                             });
  computation.loaded() = {1, 1};
}

}  // namespace

StaticsReport compute_statics(Session& session, const StaticsOptions& options) {
  refuse_sought_efforts(session.model(), "a static analysis");
  const System& system = session.system();
  Computation computation(session);
  State& state = computation.state();
  StaticsReport report;
  const StartConditions conditions = session.start_conditions();
  note_dropped_rates(system, conditions, computation);
  Environment statics = session.environment();
  statics.statics = true;
  const double from = session.loaded().factor;
  const LoadRamp ramp(system, statics, session.loaded());
  system.begin_motion(state, statics, false);
  if (!computation.started()) {
    ramp.set_off(state);  // drives and supports start at their positions for the first load factor
    assemble_positions(system, session.environment(), state, report.start, conditions);
    computation.set_started();
  }
  const std::vector<double>& wanted = session.recording().load_factors;
  std::set<double> met;
  try {
    follow_loads(session, options, statics, computation, report, [&](const State& found, const StaticPoint& point) {
      computation.loaded() = {point.factor, ramp.motion(point.factor)};
      const bool asked_for = std::binary_search(wanted.begin(), wanted.end(), point.factor);
      if (asked_for) met.insert(point.factor);
      show_point(session, found, point, wanted.empty() || asked_for || point.limit, computation);
      ++report.points;
      report.iterations += point.iterations;
      report.load_factor = point.factor;
      if (Notes* notes = session.notes())
        notes->progress(point.done, [&] { return fmt::format("load factor {:.4g}", point.factor); });
      session.call_back();
      if (session.stopping()) throw Stopped();
    });
  } catch (const Stopped&) {
    if (&computation.shown() != &state) state = computation.shown();
  }
  for (const double factor : wanted)
    if (!session.stopping() && !met.contains(factor))
      computation.note(
          fmt::format("the analysis did not meet the load factor {:.6g} of `output`: it went from {:.6g} to {:.6g}",
                      factor, from, session.loaded().factor));
  report.log.loose = loose_unknown(system, ramp.environment(session.loaded().factor), state);
  if (const std::vector<std::string> held = held_names(system, state); !held.empty())
    computation.note(describe_held(held));
  return report;
}

}  // namespace bielle::mechanism
