#include "mechanism/session/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "mechanism/session/computation.hpp"
#include "mechanism/session/interrupted.hpp"
#include "mechanism/session/motion_steps.hpp"
#include "mechanism/session/session.hpp"
#include "mechanism/solvers/constraints/sought_efforts.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/start/rigid_start.hpp"
#include "mechanism/solvers/statics/load_ramp.hpp"
#include "mechanism/solvers/statics/statics.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

Motion::Motion(Session& session, const DynamicsOptions& options) : session_(session), options_(options) {
  if (!(options.duration > 0) || !(options.stepping.size > 0))
    throw InputError("a motion needs a duration and a step greater than 0");
  refuse_sought_efforts(session.model(), "a dynamic analysis");
  computation_ = std::make_unique<Computation>(session);
  const System& system = session.system();
  const Environment& environment = session.environment();
  State state = session.state();
  // All loads and prescribed motions act fully, even if a static analysis stopped before.
  apply_motions(system, 1, state);
  system.begin_motion(state, environment, false);
  const StartConditions conditions = session.start_conditions();
  if (!conditions.empty() || !options.held.empty()) assemble_positions(system, environment, state, start_, conditions);
  if (options.equilibrium) {
    AssemblyOptions held;
    held.kept_coordinates = options.held;
    settle(system, environment, options.newton, with_kept(system, environment, state, {}, held).coordinates, state,
           start_);
  }
  if (!conditions.empty()) begin_velocities(system, environment, state, conditions, start_);
  parts_.begin = state.time;
  end_ = parts_.begin + options.duration;
  const StepOptions stepping = stepping_of(options, system, parts_.begin, session.notes());
  parts_.integration = std::make_unique<TimeIntegration>(system, environment, options.scheme, std::move(state),
                                                         options.form, options.newton);
  start_.add(parts_.integration->start_report());
  parts_.energy_balance.start(parts_.begin, system.energy(this->state(), environment));
  make_march(parts_, stepping);
  StepRecord row;
  row.energy = energy();
  row.balance = balance();
  row.step = stepping.size;
  session_.recorder().record(this->state(), environment, row);
  session.gather(this->state(), environment);
  computation_->set_report(row);
  show();  // called last, so that the session shows no motion if the constructor throws
  if (session.recording().checkpoint > 0) save_for_sinks();
}

Motion::Motion(Session& session, const DynamicsOptions& options, Archive& archive, ResultSink* sink,
               const std::optional<StepRecord>& report)
    : session_(session), options_(options) {
  std::string why;
  try {
    go_on(archive, sink);
  } catch (const std::out_of_range& error) {
    why = error.what();
  }
  if (!why.empty())
    throw InputError(
        "the state to continue from (the last checkpoint, or a saved state) does not hold the numbers that this "
        "program needs: it was written by another version, or is damaged: " +
        why);
  end_ = parts_.begin + options.duration;
  saved_ = true;
  show();
  StepRecord last;
  last.energy = energy();
  last.balance = balance();
  computation_->set_report(report.value_or(last));
}

Motion::~Motion() {
  if (computation_) computation_->end_motion();
}

void Motion::show() {
  last_begin_ = std::numeric_limits<double>::infinity();
  computation_->show(*this);
}

void Motion::end_computation() { computation_.reset(); }

Session& Motion::alive() const {
  if (!computation_) throw std::logic_error("this motion has ended: its session was asked for something else");
  return session_;
}

void Motion::make_march(Parts& parts, StepOptions stepping) {
  parts.march =
      std::make_unique<March>(*parts.integration, parts.begin, parts.begin + options_.duration, std::move(stepping));
  // A Motion can be neither copied nor moved: `this` stays valid.
  parts.march->on_jump([this](const Jump& jump) {
    parts_.energy_balance.jump(jump.before, jump.after, jump.work);
    prescribed_jumps_.add(session_.system(), jump);
  });
  if (session_.watches_attempts())
    parts.march->observe([this](const Attempt& attempt) {
      if (!session_.recorder().muted()) computation_->note(attempt);
    });
}

// -- moving

StepRecord Motion::row(const MarchStep& step, const EnergyBalance& energy_balance) const {
  StepRecord row;
  row.energy = energy_balance.totals();
  row.balance = energy_balance.balance();
  row.step = step.report.size;
  row.newton_iterations = step.report.iterations;
  row.error_estimate = step.error;
  row.worst_residual = step.report.worst_ratio;
  row.worst_equation = step.report.worst_equation;
  return row;
}

void Motion::record_step(const MarchStep& step, double before, const EnergyBalance& balance_before) {
  const Recording& recording = session_.recording();
  const Environment& environment = session_.environment();
  Recorder& recorder = session_.recorder();
  const State& now = state();
  if (now.time > before) last_recorded_ = false;  // an event at the start ends a run without a step
  if (!recording.times.empty()) {
    for (auto time = std::upper_bound(recording.times.begin(), recording.times.end(), before);
         time != recording.times.end() && *time <= now.time; ++time) {
      const State state = *time == now.time ? now : interpolated(*time);
      EnergyBalance energy_balance = balance_before;
      energy_balance.advance(*time, session_.system().energy(state, environment));
      recorder.record(state, environment, row(step, energy_balance));
      last_recorded_ = *time == now.time;
    }
    if (!parts_.march->stopped()) return;
  } else if (!(step.on_grid && parts_.grid_steps % recording.every == 0) && !done()) {
    return;
  }
  if (last_recorded_) return;
  recorder.record(now, environment, session_.report());
  last_recorded_ = true;
}

bool Motion::step() {
  Session& session = alive();
  if (done()) return false;
  take_step(true);
  if (const int every = session.recording().checkpoint; every > 0 && last_on_grid_ && parts_.grid_steps % every == 0)
    save_for_sinks();
  if (session.notes())
    session.notes()->progress((time() - begin()) / (end() - begin()),
                              [&] { return fmt::format("t = {:.4g} s", time()); });
  session.call_back();
  return true;
}

/// @param seen  whether sinks, notes and callbacks receive the step
void Motion::take_step(bool seen) {
  const double before = time();
  last_begin_ = std::numeric_limits<double>::infinity();  // in case the step fails
  const EnergyBalance balance_before = parts_.energy_balance;
  MarchStep step = parts_.march->advance();
  ++parts_.steps;
  last_begin_ = before;
  last_on_grid_ = step.on_grid;
  saved_ = false;
  if (!cautioned_ && seen)
    if (const std::string caution = parts_.integration->caution(); !caution.empty()) {
      computation_->note(caution);
      cautioned_ = true;
    }
  parts_.energy_balance.advance(time(), session_.system().energy(state(), session_.environment()), scheme_loss());
  if (step.on_grid) ++parts_.grid_steps;
  computation_->set_report(row(step, parts_.energy_balance));
  record_step(step, before, balance_before);
  session_.gather(state(), session_.environment());
  parts_.march->settle(step);  // called after the last row, because rows at jumps are recorded before the jumps
  const auto& functions = session_.system().event_functions();
  for (const Passed& passed : step.passed) {
    last_event_ = functions[static_cast<std::size_t>(passed.event_function)].name;
    if (seen) computation_->note(Event{passed.time, passed.event_function, last_event_});
  }
}

State Motion::interpolated(double at) const {
  if (at == time()) return state();
  if (!(at >= last_begin_ && at < time()))
    throw InputError(fmt::format("t = {:.6g} s is not within the last step, {}", at,
                                 last_begin_ < time() ? fmt::format("from {:.6g} to {:.6g} s", last_begin_, time())
                                                      : std::string("of which there is none yet")));
  return parts_.integration->interpolated(at);
}

void Motion::set_memory(int place, double value, bool smooth) {
  parts_.integration->set_memory(place, value);
  if (!smooth) parts_.march->begin_branch();
  saved_ = anchored_ = false;
}

std::vector<std::string> Motion::warnings() const {
  std::vector<std::string> warnings = parts_.march->warnings();
  for (std::string& warning : prescribed_jumps_.warnings(parts_.energy_balance.largest()))
    warnings.push_back(std::move(warning));
  return warnings;
}

bool Motion::advance_to(double until) {
  Session& session = alive();
  session.forget_stop();
  const double rounding = 1e-9 * options_.stepping.size;
  while (time() < until - rounding) {
    if (!step() || session.stopping()) break;
    alive();  // a callback may have started another computation of the session
  }
  return time() >= until - rounding;
}

bool Motion::finish() {
  Session& session = alive();
  session.forget_stop();
  try {
    while (!session.stopping() && step()) alive();
  } catch (const Interrupted&) {
    save_where_interrupted();
    throw;
  } catch (const ComputationError&) {
    if (computation_) save_for_sinks();
    throw;
  } catch (...) {
    save_where_interrupted();
    throw;
  }
  if (session.stopping() && !last_recorded_ && session.recording().times.empty()) {
    session_.recorder().record(state(), session.environment(), session.report());
    last_recorded_ = true;
  }
  save_for_sinks();
  return done();
}

}  // namespace bielle::mechanism
