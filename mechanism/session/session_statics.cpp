// Statics of a session: how they begin, the points that are recorded, and what is said of them.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "mechanism/session/session.hpp"
#include "mechanism/solvers/constraints/sought_efforts.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/statics/held_states.hpp"
#include "mechanism/solvers/statics/static_tangent.hpp"
#include "mechanism/solvers/statics/statics.hpp"

namespace bielle::mechanism {

void Session::statics_point(const State& state, double factor, int iterations, bool recorded) {
  shown_ = &state;
  acting_ = environment_;
  acting_.statics = true;
  acting_.load_factor = factor;
  acting_.gravity *= factor;
  report_.emplace();
  report_->energy = system_.energy(state, acting_);
  report_->energy.input = report_->energy.dissipation = 0;  // no rates in statics: there is no power to integrate
  report_->newton_iterations = iterations;
  report_->time = factor;
  if (recorded) record(state, acting_, *report_);
  gather(state, acting_);
}

void Session::note_dropped_rates(const StartConditions& conditions) const {
  VectorX v(system_.dofs()), unused(system_.dofs());
  system_.get_rates(state_, v, unused);
  const bool any_rate = std::any_of(conditions.coordinates.begin(), conditions.coordinates.end(),
                                    [](const CoordinateCondition& each) { return each.rate.value_or(0) != 0; });
  if (!v.isZero(0) || any_rate)
    note(
        "a static analysis is at rest, and so is what comes after it: the velocities are dropped (a dynamic "
        "analysis with `start: equilibrium` keeps them)");
}

void Session::follow_loads(const StaticsOptions& options, const Environment& statics, StaticsReport& report,
                           const StaticsPoint& point) {
  const Loaded begin = loaded_;
  if (options.path) {
    PathOptions path = *options.path;
    path.stops = recording_.load_factors;
    loaded_ = follow_path(system_, statics, begin, path, options.newton, state_,
                          [&](const State& state, const PathPoint& at) {
                            if (at.limit) report.limit_points.push_back(at.load_factor);
                            if (at.bifurcation) report.log.critical.push_back(*at.bifurcation);
                            report.log.unstable = at.unstable;
                            point(state, at.load_factor, at.iterations, at.done, at.limit);
                          });
    return;
  }
  LoadSteps steps(options.steps, begin);
  steps.branch = options.branch;
  steps.stops = recording_.load_factors;
  report.log = solve_statics(system_, statics, steps, options.newton, state_,
                             [&](const State& state, double factor, int iterations) {
                               const double way = 1 - begin.factor;
                               point(state, factor, iterations, way == 0 ? 1 : (factor - begin.factor) / way, false);
                             });
  loaded_ = {1, 1};
}

StaticsReport Session::statics(const StaticsOptions& options) {
  refuse_sought_efforts(model_, "a static analysis");
  at_rest();
  stopping_ = false;
  StaticsReport report;
  const StartConditions conditions = start_conditions();
  note_dropped_rates(conditions);
  Environment statics = environment_;
  statics.statics = true;
  const double from = loaded_.factor;
  const LoadRamp ramp(system_, statics, loaded_);
  system_.begin_motion(state_, statics, false);
  if (!started_) {
    ramp.set_off(state_);  // drives and supports stand where the load factor begins
    assemble_positions(system_, environment_, state_, report.start, conditions);
    started_ = true;
  }
  const std::vector<double>& wanted = recording_.load_factors;
  std::set<double> met;
  try {
    follow_loads(options, statics, report,
                 [&](const State& state, double factor, int iterations, double done, bool limit) {
                   loaded_ = {factor, ramp.motion(factor)};
                   const bool asked_for = std::binary_search(wanted.begin(), wanted.end(), factor);
                   if (asked_for) met.insert(factor);
                   statics_point(state, factor, iterations, wanted.empty() || asked_for || limit);
                   ++report.points;
                   report.iterations += iterations;
                   report.load_factor = factor;
                   if (notes_) notes_->progress(done, fmt::format("load factor {:.4g}", factor));
                   call_back();
                   if (stopping_) throw Stopped();
                 });
  } catch (const Stopped&) {
    if (shown_ != &state_) state_ = *shown_;
  } catch (...) {
    shown_ = &state_;
    throw;
  }
  shown_ = &state_;
  for (const double factor : wanted)
    if (!stopping_ && !met.contains(factor))
      note(fmt::format("the analysis did not meet the load factor {:.6g} of `output`: it went from {:.6g} to {:.6g}",
                       factor, from, loaded_.factor));
  report.log.loose = loose_unknown(system_, ramp.environment(loaded_.factor), state_);
  if (const std::vector<std::string> held = held_names(system_, state_); !held.empty()) note(describe_held(held));
  return report;
}

}  // namespace bielle::mechanism
