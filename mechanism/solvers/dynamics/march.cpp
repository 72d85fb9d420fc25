#include "mechanism/solvers/dynamics/march.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "mechanism/model/event_actions.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/system/sampling.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the tolerance for times of events [s], which is far below the error of a step of size h, far above rounding.
double tolerance_of(double h, double time) {
  return std::max(1e-10 * h, 16 * std::numeric_limits<double>::epsilon() * std::abs(time));
}

/// Returns the size of the next step after one of size h. @param error  relative to the tolerance
double proposed_size(double h, double error, double largest) {
  const double factor = 0.9 * std::cbrt(1 / std::max(error, 1e-6));
  if (error > 1) return h * std::clamp(factor, 0.1, 0.9);
  if (factor > 0.9 && factor < 1.25) return h;
  return std::min(h * std::clamp(factor, 0.5, 2.0), largest);
}

}  // namespace

March::March(TimeIntegration& integration, double begin, double end, StepOptions options)
    : integration_(integration),
      end_(end),
      options_(std::move(options)),
      stops_(begin, end, options_, Samplers(integration.system()).instants()),
      norm_(integration.system(), integration.environment(), integration.state()),
      watch_(integration.system()),
      pulses_(integration.system(), begin, end - begin, norm_.length()) {
  const bool adaptive = options_.tolerance > 0;
  stops_.advance(integration.state().time);
  size_ = adaptive ? std::min(options_.size, options_.largest) : stops_.step_size();
  smallest_ = adaptive ? 1e-10 * (end - begin) : size_ / 1024;
  const std::vector<double>& kinks = options_.break_points;
  if (std::find(kinks.begin(), kinks.end(), begin) != kinks.end()) pending_ = Pending::branch;
}

bool March::done() const { return stopped_ || integration_.state().time >= end_; }

void March::exchange(Archive& archive) {
  auto pending = static_cast<int>(pending_);
  archive.within(pending, static_cast<int>(Pending::nothing), static_cast<int>(Pending::branch));
  pending_ = static_cast<Pending>(pending);
  archive(size_);
  if (!(size_ > 0)) throw std::out_of_range("the size of the next step is not greater than 0");
  MarchLog whole = before_.followed_by(log_);
  whole.exchange(archive, integration_.system().size());
  if (archive.restoring()) {
    before_ = whole;
    log_ = {};
  }
  norm_.exchange(archive);  // also with fixed steps: adaptive ones may continue them
  watch_.exchange(archive);
  VectorX crossed = VectorX::Zero(static_cast<Eigen::Index>(integration_.system().event_functions().size()));
  for (const int k : crossed_) crossed[k] = 1;
  for (double& flag : crossed) archive.within(flag, 0, 1);
  crossed_.clear();
  for (int k = 0; k < static_cast<int>(crossed.size()); ++k)
    if (crossed[k] != 0) crossed_.push_back(k);
  archive(stopped_);
  archive(last_event_);
  archive.within(events_at_once_, 0, 1e15);
  stops_.advance(integration_.state().time);
}

/// @param before  jump of a branch that began here just before; it is replaced by the new one
void March::begin_branch(double h, std::optional<Jump>& before) {
  if (before && jump_listener_) jump_listener_(*before);
  std::vector<int> begins;  // events that begin the branch
  for (const int k : crossed_)
    if (integration_.system().event_functions()[static_cast<std::size_t>(k)].function.restarts) begins.push_back(k);
  before = integration_.begin_branch(h, begins);
}

/// Ends the step at the next time at which a delay returns a jump.
void March::heed_echoes() { stops_.heed(integration_.next_echo(stops_.just_after(integration_.state().time))); }

void March::begin_step(MarchStep& step) {
  heed_echoes();
  double h = std::min(size_, stops_.time() - integration_.state().time);
  if (is_short(h)) h = size_;  // the scheme gets values for the steps that follow the short one
  if (pending_ == Pending::start) integration_.start(h);
  if (pending_ == Pending::restart) integration_.restart(h);
  begin_branches(h, step);
  heed_echoes();  // includes those of jumps that have just occurred
}

/// Begins the branches of events and kinks at the start of a step.
void March::begin_branches(double h, MarchStep& step) {
  std::optional<Jump> jump;  // the last jump, which is followed by the step
  if (pending_ == Pending::branch) begin_branch(h, jump);
  begun_anew_ = pending_ != Pending::nothing;
  pending_ = Pending::nothing;
  if (!watch_.idle()) {
    pass_jumps(h, watch_.begin(integration_.state(), integration_.environment(), crossed_), jump, step);
  }
  if (!stopped_) crossed_.clear();
  if (!jump) return;
  begun_anew_ = true;
  integration_.start_branch(h, jump->time);
  if (jump_listener_) jump_listener_(*jump);
}

bool March::has_actions_to_do() const {
  const System& system = integration_.system();
  const auto acts = [&](int k) {
    const MemberEventFunction& event = system.event_functions()[static_cast<std::size_t>(k)];
    const Component* component = system.model().members()[event.member].component.get();
    const auto* actions = dynamic_cast<const EventActions*>(component);
    return actions && actions->has_actions();
  };
  return pending_ == Pending::branch && std::any_of(crossed_.begin(), crossed_.end(), acts);
}

void March::settle(MarchStep& step) {
  if (!done() || !has_actions_to_do()) return;
  const bool stopped = stopped_;
  constexpr int most = 100;  // later events may stop the run as well
  for (int k = 0; k < most && has_actions_to_do(); ++k) {
    stopped_ = false;
    begin_branches(size_, step);
  }
  stopped_ = stopped_ || stopped;
}

/// Treats events that were passed by a jump, at a discontinuity, or when the accelerations of a short span were
/// computed. They may begin further branches there.
void March::pass_jumps(double h, std::vector<int> jumped, std::optional<Jump>& jump, MarchStep& step) {
  // Branches that begin simultaneously may reverse each other repeatedly. If they begin one after the other, this ends.
  constexpr int together = 10, most = 100;
  for (int k = 0; !jumped.empty(); ++k) {
    if (k == most) throw_chattering(jumped.front());
    crossed_.clear();
    note(jumped, step);
    if (stopped_) return;  // the events that stopped the run may still have actions, see settle
    const bool restarts = pending_ == Pending::branch;
    pending_ = Pending::nothing;
    if (!restarts) return;
    begin_branch(h, jump);
    jumped = watch_.begin(integration_.state(), integration_.environment(), {}, k >= together);
  }
}

/// Returns whether a span is too short for the scheme. Such a span is the remainder after an event or a kink, not a
/// step that was reduced.
bool March::is_short(double h) const {
  constexpr double share = 0.01;
  return h < share * size_ && h < integration_.longest_short_span();
}

StepReport March::attempt(double h, double end, bool kink) {
  constexpr double small = 1e-6;  // relevant time constants are longer
  // A step of this fraction is shorter than all relevant time constants.
  const bool cut = !begun_anew_ && h < 0.49 * size_;
  StepReport report = is_short(h) ? integration_.attempt_short(h, end, kink, h < small * size_)
                      : cut       ? integration_.attempt_settled(h, end, kink)
                                  : integration_.attempt(h, end, kink);
  log_.iterations += report.iterations;
  log_.factorisations += report.factorisations;
  log_.shortened += report.shortened;
  return report;
}

/// Computes the scheme's values for steps of another size, unless the span is too short to have any.
void March::change_step(double h) {
  if (!is_short(h)) integration_.change_step(h);
}

/// If the attempted step contains an event, attempts shorter ones until it ends just past the first event.
/// @returns the size of that step, or 0 if it contains none, or if a shorter step failed (the report then contains the
/// reason)
double March::locate(double time, StepReport& report) {
  const double h = report.size;
  const double tolerance = tolerance_of(h, time);
  if (watch_.idle() || !watch_.found(integration_.attempted(), integration_.environment(), h, tolerance)) return 0;
  constexpr int most = 60;  // bisection alone needs about 35
  integration_.share_factors(true);
  double last = h;
  for (int k = 0; k < most && !watch_.located(); ++k) {
    last = watch_.proposal();
    change_step(last);
    report = attempt(last, time + last, false);
    if (!report.converged()) break;
    watch_.narrow(integration_.attempted(), integration_.environment(), last);
  }
  // The last attempt may have ended before the event.
  if (report.converged() && last != watch_.behind()) report = attempt(watch_.behind(), time + watch_.behind(), false);
  integration_.share_factors(false);
  return report.converged() ? watch_.behind() : 0;
}

/// Processes the events at the end of an accepted step. Events accumulate at an instant if they follow each other at
/// once many times, or ever faster until their intervals are rounding errors (Zeno's paradox): the next one could be
/// missed.
void March::pass_events(MarchStep& step) {
  const double time = integration_.state().time, interval = time - last_event_;
  constexpr double at_once = 1e-7, negligible = 1e-10;  // relative to the step
  constexpr long most = 1000, most_faster = 20;
  events_at_once_ = interval <= at_once * size_ ? events_at_once_ + 1 : 0;
  events_faster_ = interval > 0 && interval < last_interval_ ? events_faster_ + 1 : 0;
  last_event_ = time;
  last_interval_ = interval;
  const std::vector<int> passed = watch_.pass();
  if (events_at_once_ > most || (events_faster_ > most_faster && interval < negligible * size_))
    throw_chattering(passed.front());
  note(passed, step);
}

void March::throw_chattering(int event_function) const {
  throw ComputationError(
      fmt::format("t = {:.6g} s: {} occurs again and again while the time does not advance; give the contact some "
                  "compliance, or the switch some hysteresis",
                  integration_.state().time,
                  integration_.system().event_functions()[static_cast<std::size_t>(event_function)].name));
}

void March::note(const std::vector<int>& passed, MarchStep& step) {
  const double time = integration_.state().time;
  for (const int k : passed) {
    const EventFunction& function = integration_.system().event_functions()[static_cast<std::size_t>(k)].function;
    step.passed.push_back({time, k});
    crossed_.push_back(k);
    ++log_.crossings;
    if (function.stops) stopped_ = true;
    if (function.restarts) pending_ = Pending::branch;
  }
}

void March::refuse_by_newton(double h, const StepReport& report) {
  ++log_.refused_by_newton;
  log_.hardest = report.refusal;
  size_ = h / 2;
  if (size_ >= smallest_) return;
  const std::string singular =
      describe_singularity(integration_.system(), integration_.environment(), integration_.state());
  throw ComputationError(fmt::format("{}; steps down to {:.3g} s have been tried{}{}", report.refusal, h,
                                     singular.empty() ? "" : "; ", singular));
}

void March::refuse_by_error(double h, double error) {
  ++log_.refused_by_error;
  size_ = proposed_size(h, error, options_.largest);
  if (size_ < smallest_)
    throw ComputationError(
        fmt::format("t = {:.6g} s: the local error stays {:.3g} times the tolerance with a step of {:.3g} s",
                    integration_.state().time, error, h));
}

March::Plan March::plan() const {
  Plan plan;
  plan.begin = integration_.state().time;
  const double left = stops_.time() - plan.begin;
  // The last two steps before a stop have the same size, so that no short step remains.
  plan.last = left <= size_ * (1 + 1e-9);
  plan.size = plan.last ? left : left < 2 * size_ ? left / 2 : size_;
  plan.end = plan.last ? stops_.time() : plan.begin + plan.size;
  plan.kink = plan.last && stops_.at_kink();
  return plan;
}

/// Returns the error, relative to the tolerance, due to formulas of time that act between the ends of an attempted step
/// but not at them. It is 0 with fixed steps, because their run reports the error at its end.
double March::missed(const Plan& plan) {
  if (pulses_.idle()) return 0;
  pulses_.look(integration_.attempted(), integration_.environment(), plan.begin, plan.end);
  return adaptive() ? pulses_.error(integration_.environment(), norm_, options_.tolerance) : 0;
}

/// Attempts the planned step: it is computed, its error is checked, and it is shortened to the first event within.
/// @param too_large  number of consecutive attempts in this step with too large an error
/// @returns whether it is to be accepted; otherwise the step size has been reduced
bool March::try_step(const Plan& plan, int& too_large, Trial& trial) {
  // The local error decreases with the third power of the step. If it does not, changes of the step size have left
  // errors in the algorithmic accelerations. These are then recomputed from equilibrium.
  constexpr int most = 2;
  if (too_large >= most)
    integration_.restart(plan.size);
  else
    change_step(plan.size);
  trial = Trial{};
  trial.report = attempt(plan.size, plan.end, plan.kink);
  if (trial.report.converged()) {
    const double pulse = missed(plan);
    const bool judged = !is_short(plan.size);  // the error of a series over a short span is negligible
    if (adaptive() && judged) trial.error = std::max(norm_(integration_) / options_.tolerance, pulse);
    trial.error_known = judged && integration_.first_order_error_known();
    if (trial.error > 1) {
      tell(Attempt::Outcome::refused_by_error, plan, trial);
      ++too_large;
      refuse_by_error(plan.size, trial.error);
      return false;
    }
    trial.to_event = locate(plan.begin, trial.report);
  }
  if (trial.report.converged()) return true;
  trial.error = 0;
  tell(Attempt::Outcome::refused_by_newton, plan, trial);
  refuse_by_newton(plan.size, trial.report);
  return false;
}

void March::tell(Attempt::Outcome outcome, const Plan& plan, const Trial& trial) const {
  const double size = trial.to_event > 0 ? trial.to_event : plan.size;
  if (observer_) observer_({outcome, plan.begin + size, trial.report, trial.error});
}

void March::count(const Plan& plan, const Trial& trial) {
  ++log_.steps;
  if (trial.report.iterations > log_.most_iterations) {
    log_.most_iterations = trial.report.iterations;
    log_.most_iterations_at = integration_.state().time;
    log_.slowest_equation = trial.report.worst_equation;
  }
  if (plan.kink || trial.to_event > 0 || integration_.is_short()) return;
  log_.smallest = log_.smallest > 0 ? std::min(log_.smallest, plan.size) : plan.size;
  log_.largest = std::max(log_.largest, plan.size);
}

/// Processes the events within an accepted step that change nothing.
void March::pass_noted(double begin, MarchStep& step) {
  if (watch_.idle()) return;
  const double end = integration_.state().time;
  const auto noted = watch_.pass_noted(
      begin, end, [this](double time) { return integration_.interpolated(time); }, integration_.environment(),
      tolerance_of(end - begin, begin));
  for (const EventLocator::Noted& each : noted) {
    step.passed.push_back({each.time, each.event_function});
    crossed_.push_back(each.event_function);
    ++log_.crossings;
  }
}

MarchStep March::advance() {
  MarchStep step{{}, 0, adaptive(), {}};
  begin_step(step);
  if (stopped_) {
    step.on_grid = false;
    return step;
  }
  int too_large = 0;
  Trial trial;
  Plan planned = plan();
  while (!try_step(planned, too_large, trial)) planned = plan();
  const bool branch_left = integration_.accept();
  tell(Attempt::Outcome::accepted, planned, trial);
  count(planned, trial);
  step.report = trial.report;
  step.error = trial.error;
  if (integration_.is_short()) pending_ = Pending::restart;
  if (!pulses_.idle()) {
    if (trial.to_event > 0)
      pulses_.look(integration_.state(), integration_.environment(), planned.begin, integration_.state().time);
    pulses_.add(integration_.state().time);
  }
  pass_noted(planned.begin, step);
  if (trial.to_event > 0) pass_events(step);
  std::stable_sort(step.passed.begin(), step.passed.end(),
                   [](const Passed& a, const Passed& b) { return a.time < b.time; });
  if (branch_left) pending_ = Pending::branch;
  if (trial.to_event > 0 && integration_.state().time < planned.end) {
    step.on_grid = false;
    return step;
  }
  // A step with unknown error does not justify a larger one.
  if (adaptive())
    size_ = std::max(trial.error_known ? proposed_size(planned.size, trial.error, options_.largest) : planned.size,
                     planned.last ? size_ : 0);
  else
    size_ = std::min(2 * size_, stops_.step_size());
  step.on_grid = adaptive() || (planned.last && stops_.on_grid());
  if (planned.kink) pending_ = Pending::branch;
  if (planned.last) stops_.advance(stops_.time());
  return step;
}

}  // namespace bielle::mechanism
