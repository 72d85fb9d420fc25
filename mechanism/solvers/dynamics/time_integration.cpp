#include "mechanism/solvers/dynamics/time_integration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/solvers/constraints/activated_fit.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/dynamics/stabilised_equations.hpp"
#include "mechanism/solvers/dynamics/start_values.hpp"
#include "mechanism/solvers/start/consistent_accelerations.hpp"
#include "mechanism/solvers/start/consistent_start.hpp"
#include "mechanism/solvers/start/consistent_velocities.hpp"
#include "mechanism/solvers/start/massless_balance.hpp"
#include "mechanism/solvers/start/one_sided_holds.hpp"
#include "mechanism/solvers/start/refused_holds.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the distance from a kink at which its two sides can be distinguished despite rounding [s].
double just_off(double time, double h) {
  return 1e-12 * h + 8 * std::numeric_limits<double>::epsilon() * std::abs(time);
}

/// Returns the rates that drives and supports prescribe at a time: those of the constraint rows and of the nodes while
/// everything else is at rest.
VectorX prescribed_rates(const System& system, const Environment& environment, State state, double time) {
  state.time = time;
  system.set_rates(state, VectorX::Zero(system.dofs()), VectorX::Zero(system.dofs()));
  VectorX rows = VectorX::Zero(system.multipliers()), unused(system.multipliers());
  system.constraint_rates(state, environment, rows, unused);
  VectorX rates(rows.size() + 6 * static_cast<Eigen::Index>(state.nodes.size()));
  rates.head(rows.size()) = rows;
  for (Eigen::Index i = rows.size(); const NodeState& node : state.nodes) {
    rates.segment<3>(i) = node.v;
    rates.segment<3>(i + 3) = node.Omega;
    i += 6;
  }
  return rates;
}

/// Returns whether one of these rates differs just before and just after a time by more than rounding errors, either of
/// its own value or of the rates with which the mechanism moves.
bool prescribed_rates_jump(const System& system, const Environment& environment, const State& state, double off) {
  const VectorX before = prescribed_rates(system, environment, state, state.time - off);
  const VectorX after = prescribed_rates(system, environment, state, state.time + off);
  VectorX v(system.dofs()), a(system.dofs());
  system.get_rates(state, v, a);
  const double rounding = 1e-9 * v.lpNorm<Eigen::Infinity>();
  for (Eigen::Index i = 0; i < before.size(); ++i)
    if (std::abs(after[i] - before[i]) > std::max(rounding, 1e-6 * std::max(std::abs(before[i]), std::abs(after[i]))))
      return true;
  return false;
}

std::unique_ptr<StepEquations> equations_of(const System& system, ConstraintForm form) {
  if (form == ConstraintForm::stabilised && system.multipliers() > 0)
    return std::make_unique<StabilisedEquations>(system);
  return std::make_unique<StepEquations>(system);
}

}  // namespace

TimeIntegration::TimeIntegration(const System& system, const Environment& environment, const Scheme& scheme,
                                 State state, ConstraintForm form, const NewtonOptions& options)
    : system_(system),
      environment_(environment),
      step_(system, scheme, std::move(state)),
      correction_(system, environment_, form),
      newton_(system, environment_, equations_of(system, form), options),
      event_function_values_(system),
      extrapolation_(system.size(), options.extrapolation),
      short_span_(system, environment_),
      samplers_(system),
      echoes_(system) {
  start_report_ = make_consistent(system_, environment_, step_.state());
  step_.take_rates();
  system_.accept(step_.state(), environment_);
  if (samplers_.take(step_.state(), environment_)) {
    make_consistent_anew(start_report_);
    echoes_.note_jump(step_.state(), environment_, step_.state().time);
  }
  step_.trial() = step_.state();
  extrapolate_from_here();
}

TimeIntegration::TimeIntegration(const System& system, const Environment& environment, const Scheme& scheme,
                                 Archive& archive, ConstraintForm form, const NewtonOptions& options)
    : system_(system),
      environment_(environment),
      step_(system, scheme, system.start(0)),
      correction_(system, environment_, form),
      newton_(system, environment_, equations_of(system, form), options),
      event_function_values_(system),
      extrapolation_(system.size(), options.extrapolation),
      short_span_(system, environment_),
      samplers_(system),
      echoes_(system) {
  exchange(archive);
}

void TimeIntegration::exchange(Archive& archive) {
  step_.exchange(archive);
  correction_.exchange(archive);
  extrapolation_.exchange(archive);
  loss_.exchange(archive);
  newton_.begin_anew();
}

/// Discards all data from before the accepted state.
void TimeIntegration::extrapolate_from_here() {
  extrapolation_.forget();
  step_.get_highest(highest_);
  extrapolation_.add(state().time, highest_);
}

void TimeIntegration::start(double h) { set_start_values(step_, environment_, correction_, h); }

void TimeIntegration::change_step(double h) {
  if (!StepNewton::same_size(h, step_.size())) change_step_size(step_, correction_, h);
}

void TimeIntegration::restart(double h) {
  const double time = state().time;
  step_.state().time += just_off(time, h);
  StartReport unused;
  start_anew(h, unused);
  step_.state().time = time;
  extrapolate_from_here();
}

void TimeIntegration::start_anew(double h, StartReport& report) {
  make_consistent_anew(report);
  start(h);
}

void TimeIntegration::make_consistent_anew(StartReport& report) {
  State& state = step_.state();
  KktMatrix& saddle = correction_.saddle();
  const State begun = state;
  StartReport exchanged = report;
  // The same factorisation is used for both.
  make_velocities_consistent(system_, environment_, state, report, saddle);
  make_accelerations_consistent(system_, environment_, state, saddle);
  if (exchange_one_sided(system_, environment_, begun, state, exchanged, saddle)) report = std::move(exchanged);
  balance_massless(system_, environment_, state, report);
  step_.take_rates();
}

Jump TimeIntegration::begin_branch(double h, const std::vector<int>& crossed) {
  State& state = step_.state();
  Jump jump;
  jump.time = state.time;
  jump.crossed = crossed;
  jump.before = system_.energy(state, environment_);
  jump.prescribed = crossed.empty() && prescribed_rates_jump(system_, environment_, state, just_off(jump.time, h));
  state.time += just_off(jump.time, h);
  const std::vector<char> before = state.idle;
  const VectorX memory = state.memory;
  samplers_.take(state, environment_);
  const bool balanced = event_function_values_.balance(environment_, state);
  system_.begin_branch(state, environment_, crossed);
  if (balanced && !system_.reads_reactions()) state.reaction.resize(0);  // removes the reactions of the previous state
  set_redundant_aside(system_, environment_, state);
  std::vector<int> new_holds = active_holds(system_, state);
  std::erase_if(new_holds, [&](int k) { return before[static_cast<std::size_t>(k)] == Idle::active; });
  StartReport report;
  KktMatrix& saddle = correction_.saddle();
  try {
    check_activated_fit(system_, environment_, state, memory);
    if (holds_stop_more(system_, environment_, state, new_holds, saddle)) {
      refuse_holds(system_, environment_, state, std::move(new_holds), Overloaded::refused, saddle);
      make_consistent_anew(report);
    } else {
      const State begun = state;
      try {
        make_consistent_anew(report);
      } catch (const ComputationError&) {
        state = begun;
        report = {};
        // The new holds come last, because the last hold in the list is refused first.
        std::vector<int> holds = active_holds(system_, state);
        if (holds.empty()) throw;
        std::stable_partition(holds.begin(), holds.end(), [&](int k) {
          return std::find(new_holds.begin(), new_holds.end(), k) == new_holds.end();
        });
        refuse_holds(system_, environment_, state, std::move(holds), Overloaded::holds, saddle);
        make_consistent_anew(report);
      }
    }
  } catch (const ComputationError& error) {
    std::vector<std::string> events;
    for (const int k : crossed) events.push_back(system_.event_functions()[static_cast<std::size_t>(k)].name);
    if (events.empty()) throw;
    throw ComputationError(fmt::format("{}; this is where {}", error.what(), fmt::join(events, ", ")));
  }
  system_.accept_activated(state, environment_, memory);
  newton_.forget_factors();
  jump.after = system_.energy(state, environment_);
  jump.work = report.impulse_work;
  echoes_.note_jump(state, environment_, jump.time);
  state.time = jump.time;
  return jump;
}

void TimeIntegration::start_branch(double h, double time) {
  State& state = step_.state();
  state.time += just_off(time, h);
  start(h);
  state.time = time;
  extrapolate_from_here();
}

/// Begins a trial with extrapolated accelerations, rates and multipliers, and computes its residual.
/// @returns the size of the residual; infinite if a component cannot be evaluated
double TimeIntegration::begin_trial(double h, double end, int order, StepReport& report) {
  extrapolation_.calc(order, end, highest_);
  step_.begin(h, end, highest_);
  report.order = order;
  try {
    newton_.evaluate(step_, report);
  } catch (const ComputationError&) {
    if (order == 0) throw;
    return std::numeric_limits<double>::infinity();
  }
  return newton_.measures() ? newton_.size_of_residual() : 0;
}

void TimeIntegration::choose_start(double h, double end, StepReport& report) {
  const int order = extrapolation_.order(end);
  double size = begin_trial(h, end, order, report);
  const bool measured = newton_.measures();
  if (!measured || !extrapolation_.wants_choice(size)) {
    if (measured) extrapolation_.note(size);
    if (!std::isfinite(size)) begin_trial(h, end, 0, report);
    return;
  }
  // A higher order must be better by enough to compensate for its evaluation and for its dependence on earlier steps.
  constexpr double clearly = 0.7;
  int best = order;
  if (order > 0)
    if (const double other = begin_trial(h, end, order - 1, report); other * clearly <= size) {
      size = other;
      best = order - 1;
    }
  if (best == order && order < extrapolation_.highest_order(end))
    if (const double other = begin_trial(h, end, order + 1, report); other < clearly * size) {
      size = other;
      best = order + 1;
    }
  const bool refused = !std::isfinite(size);
  if (refused) best = 0;
  extrapolation_.choose(best, size);
  if (refused || report.order != best) begin_trial(h, end, best, report);
}

StepReport TimeIntegration::attempt_from(double h, double end, bool extrapolated) {
  StepReport report;
  report.size = h;
  try {
    newton_.begin(state());
    if (extrapolated)
      choose_start(h, end, report);
    else
      begin_trial(h, end, 0, report);
    newton_.solve(step_, report);
  } catch (const ComputationError& error) {
    // A component cannot be evaluated, or the equations are singular. A shorter step may not have this problem.
    report.refusal = error.what();
    newton_.explain(step_, report);
  }
  return report;
}

StepReport TimeIntegration::attempt(double h, double end, bool kink) {
  end_ = end;
  short_ = false;
  const double trial_end = kink ? end - just_off(end, h) : end;
  const StepReport report = attempt_plainly(h, trial_end);
  if (report.converged() || system_.algebraic().empty() || !newton_.search_balances(true)) return report;
  const StepReport searched = attempt_again(report, h, trial_end);
  newton_.search_balances(false);
  return searched;
}

StepReport TimeIntegration::attempt_plainly(double h, double trial_end) {
  const StepReport first = attempt_from(h, trial_end, true);
  if (first.converged() || first.order == 0) return first;
  // Newton's method may fail from extrapolated values and succeed from unchanged ones.
  extrapolation_.choose(0, std::numeric_limits<double>::infinity());
  return attempt_again(first, h, trial_end);
}

/// Attempts the step again from unchanged values. @param before  report of the failed attempts
StepReport TimeIntegration::attempt_again(const StepReport& before, double h, double end) {
  StepReport report = attempt_from(h, end, false);
  report.iterations += before.iterations;
  report.factorisations += before.factorisations;
  report.evaluations += before.evaluations;
  report.solutions += before.solutions;
  report.shortened += before.shortened;
  return report;
}

StepReport TimeIntegration::attempt_short(double h, double end, bool kink, bool small) {
  const double offset = just_off(state().time, h), trial_end = kink ? end - just_off(end, h) : end;
  KktMatrix& saddle = correction_.saddle();
  StepReport report;
  report.size = h;
  try {
    if (!short_span_.leap(step_, saddle, h, trial_end, offset, small)) {
      report = attempt(h, end, kink);
      if (report.converged()) short_span_.settle(step_, saddle);
    }
    short_ = report.converged();
    end_ = end;
    return report;
  } catch (const ComputationError&) {
    // Consistent accelerations do not exist or are not unique: a step of the scheme is still possible.
    return attempt(h, end, kink);
  }
}

StepReport TimeIntegration::attempt_settled(double h, double end, bool kink) {
  const StepReport report = attempt(h, end, kink);
  if (!report.converged() || system_.multipliers() == 0) return report;
  try {
    short_span_.settle(step_, correction_.saddle());
    short_ = true;
  } catch (const ComputationError&) {
    // Consistent accelerations do not exist or are not unique: those of the step are kept.
  }
  return report;
}

/// Accepts the trial, at whose end components update their memory. Samples that change values begin another branch.
/// They are taken when it begins, so that the accepted state is the one just before them.
/// @returns whether the motion goes on on another branch
bool TimeIntegration::accept_trial() {
  State& trial = step_.trial();
  const bool branch_left = system_.accept(trial, environment_);
  trial.time = end_;
  if (samplers_.none()) return branch_left;
  const VectorX before = trial.memory;
  if (!samplers_.take(trial, environment_)) return branch_left;
  trial.memory = before;
  return true;
}

/// Accepts a short span, to which the scheme's own values do not apply.
bool TimeIntegration::accept_short() {
  const bool branch_left = accept_trial();
  step_.accept();
  step_.take_rates();
  newton_.forget_factors();
  extrapolate_from_here();
  return branch_left;
}

bool TimeIntegration::accept() {
  check_set_aside(system_, environment_, step_.trial());
  if (short_) return accept_short();
  loss_.add(step_, environment_);
  step_.take_algorithmic_values();
  correction_.watch(step_);
  const bool branch_left = accept_trial();
  step_.accept();
  step_.get_highest(highest_);
  extrapolation_.add(end_, highest_);
  return branch_left;
}

StepReport TimeIntegration::step(double h) {
  const StepReport report = attempt(h);
  if (!report.converged()) throw ComputationError(report.refusal);
  accept();
  return report;
}

}  // namespace bielle::mechanism
