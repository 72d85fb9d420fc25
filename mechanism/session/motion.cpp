#include "mechanism/session/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

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

Motion::Motion(Session& session, const DynamicsOptions& options) : session_(&session), options_(options) {
  if (!(options.duration > 0) || !(options.stepping.size > 0))
    throw InputError("a motion needs a duration and a step greater than 0");
  refuse_sought_efforts(session.model_, "a dynamic analysis");
  session.at_rest();
  session.stopping_ = false;
  const System& system = session.system_;
  const Environment& environment = session.environment_;
  State state = session.state_;
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
  const StepOptions stepping = stepping_of(options, system, parts_.begin, session.notes_);
  parts_.integration = std::make_unique<TimeIntegration>(system, environment, options.scheme, std::move(state),
                                                         options.form, options.newton);
  start_.add(parts_.integration->start_report());
  parts_.energy_balance.start(parts_.begin, system.energy(this->state(), environment));
  make_march(parts_, stepping);
  StepRecord row;
  row.energy = energy();
  row.balance = balance();
  row.step = stepping.size;
  session.record(this->state(), environment, row);
  session.gather(this->state(), environment);
  session.report_ = row;
  show();  // shown last: if the constructor throws, the session shows no motion
  if (session.recording_.checkpoint > 0) save_for_sinks();
}

Motion::Motion(Session& session, const DynamicsOptions& options, Archive& archive, ResultSink* sink,
               const std::optional<StepRecord>& report)
    : session_(&session), options_(options) {
  std::string why;
  try {
    go_on(archive, sink);
  } catch (const std::out_of_range& error) {
    why = error.what();
  }
  if (!why.empty())
    throw InputError(
        "what is to be gone on from (the last checkpoint, or what was saved) holds other numbers than this program "
        "goes on from: it was written by another version, or is damaged: " +
        why);
  end_ = parts_.begin + options.duration;
  saved_ = true;
  show();
  if (report) {
    session.report_ = report;
  } else {
    session.report_.emplace();
    session.report_->energy = energy();
    session.report_->balance = balance();
  }
}

Motion::~Motion() {
  if (session_) session_->at_rest();
}

void Motion::show() {
  last_begin_ = std::numeric_limits<double>::infinity();
  session_->motion_ = this;
  session_->started_ = true;
  session_->shown_ = &state();
  session_->loaded_ = {1, 1};
  session_->acting_ = session_->environment_;
}

Session& Motion::alive() const {
  if (!session_) throw std::logic_error("this motion has ended: its session was asked for something else");
  return *session_;
}

void Motion::make_march(Parts& parts, StepOptions stepping) {
  parts.march =
      std::make_unique<March>(*parts.integration, parts.begin, parts.begin + options_.duration, std::move(stepping));
  // A Motion can be neither copied nor moved: `this` stays valid.
  parts.march->on_jump([this](const Jump& jump) {
    parts_.energy_balance.jump(jump.before, jump.after, jump.work);
    prescribed_jumps_.add(session_->system_, jump);
  });
  if (!session_->on_attempt_.empty())
    parts.march->observe([session = session_](const Attempt& attempt) {
      if (session->going_again_) return;
      for (const auto& callback : session->on_attempt_) callback(attempt);
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
  const Recording& recording = session_->recording_;
  const Environment& environment = session_->environment_;
  const State& now = state();
  last_recorded_ = false;
  if (!recording.times.empty()) {
    for (auto time = std::upper_bound(recording.times.begin(), recording.times.end(), before);
         time != recording.times.end() && *time <= now.time; ++time) {
      const State state = *time == now.time ? now : interpolated(*time);
      EnergyBalance energy_balance = balance_before;
      energy_balance.advance(*time, session_->system_.energy(state, environment));
      session_->record(state, environment, row(step, energy_balance));
    }
    if (parts_.march->stopped()) session_->record(now, environment, *session_->report_);
  } else if ((step.on_grid && parts_.grid_steps % recording.every == 0) || done()) {
    session_->record(now, environment, *session_->report_);
    last_recorded_ = true;
  }
}

bool Motion::step() {
  Session& session = alive();
  if (done()) return false;
  take_step(true);
  if (const int every = session.recording_.checkpoint; every > 0 && last_on_grid_ && parts_.grid_steps % every == 0)
    save_for_sinks();
  if (session.notes_)
    session.notes_->progress((time() - begin()) / (end() - begin()), fmt::format("t = {:.4g} s", time()));
  session.call_back();
  return true;
}

/// @param seen  whether sinks, notes and callbacks receive the step
void Motion::take_step(bool seen) {
  Session& session = *session_;
  const double before = time();
  last_begin_ = std::numeric_limits<double>::infinity();  // in case the step fails
  const EnergyBalance balance_before = parts_.energy_balance;
  const MarchStep step = parts_.march->advance();
  ++parts_.steps;
  last_begin_ = before;
  last_on_grid_ = step.on_grid;
  saved_ = false;
  if (!cautioned_ && seen)
    if (const std::string caution = parts_.integration->caution(); !caution.empty()) {
      session.note(caution);
      cautioned_ = true;
    }
  parts_.energy_balance.advance(time(), session.system_.energy(state(), session.environment_), scheme_loss());
  if (step.on_grid) ++parts_.grid_steps;
  session.report_ = row(step, parts_.energy_balance);
  record_step(step, before, balance_before);
  session.gather(state(), session.environment_);
  const auto& crossings = session.system_.event_functions();
  for (const Passed& passed : step.passed) {
    last_event_ = crossings[static_cast<std::size_t>(passed.crossing)].name;
    if (seen) session.note(Event{passed.time, passed.crossing, last_event_});
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
  session.stopping_ = false;
  const double rounding = 1e-9 * options_.stepping.size;
  while (time() < until - rounding) {
    if (!step() || session.stopping_) break;
    alive();  // a callback may have started another computation of the session
  }
  return time() >= until - rounding;
}

bool Motion::finish() {
  Session& session = alive();
  session.stopping_ = false;
  try {
    while (!session.stopping_ && step()) alive();
  } catch (const Interrupted&) {
    save_where_interrupted();
    throw;
  } catch (const ComputationError&) {
    if (session_) save_for_sinks();
    throw;
  } catch (...) {
    save_where_interrupted();
    throw;
  }
  if (session.stopping_ && !last_recorded_ && session.recording_.times.empty()) {
    session.record(state(), session.environment_, *session.report_);
    last_recorded_ = true;
  }
  save_for_sinks();
  return done();
}

}  // namespace bielle::mechanism
