#include "mechanism/solvers/dynamics/step_newton.hpp"

#include <limits>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

/// Number of steps after which the rounding of residuals is measured again.
constexpr int floor_lasts = 64;

}  // namespace

StepNewton::StepNewton(const System& system, const Environment& environment, std::unique_ptr<StepEquations> equations,
                       const NewtonOptions& options)
    : system_(system),
      environment_(environment),
      options_(options),
      equations_(std::move(equations)),
      convergence_(system, options),
      reactions_(system),
      policy_(options.tangent) {
  for (VectorX* vector : {&r_, &r_evaluated_, &delta_}) vector->setZero(equations_->size());
}

void StepNewton::begin_anew() {
  system_.forget_pairs();
  equations_->choose_pivots_anew();
  policy_.begin_anew();
  reactions_.begin_anew();
  factored_for_ = 0;
  floor_age_ = never_measured;
  measures_ = false;
}

void StepNewton::begin(const State& state) {
  ++floor_age_;
  equations_->begin(state, environment_);
}

void StepNewton::evaluate(SchemeStep& step, StepReport& report) {
  ++report.evaluations;
  step.show();
  // There may be no balance while the other unknowns have not converged: the trial is then used unchanged.
  if (searches_) search_->find(environment_, step.trial());
  h_ = step.trial_size();
  ResidualScale scale;
  reactions_.balance(environment_, step.trial());
  equations_->calc_residual(step.trial(), environment_, r_evaluated_, scale);
  r_.swap(r_evaluated_);
  scale_ = scale;
}

double StepNewton::size_of_residual() { return convergence_.size_of(equations_->judged(r_, h_)); }

void StepNewton::factor(SchemeStep& step, StepReport& report) {
  factored_for_ = 0;
  if (report.factorisations == 0) wasted_ = spent(report);
  equations_->factor(step, environment_);
  factored_for_ = step.trial_size();
  ++report.factorisations;
  policy_.set_costs(equations_->costs());
  if (floor_age_ < floor_lasts && same_size(step.size(), step.trial_size())) return;
  // The multipliers of the accepted state are used: those of the initial guess may have large errors.
  convergence_.measure_rounding(equations_->linear(), step.state());
  floor_age_ = 0;
}

void StepNewton::solve_with_factors(StepReport& report) {
  ++report.solutions;
  equations_->solve(r_, delta_);
}

void StepNewton::move_and_follow(SchemeStep& step, double part) {
  equations_->move(step, delta_, part);
  equations_->follow(step);
}

/// Returns the cost of the iterations so far [ns].
double StepNewton::spent(const StepReport& report) const {
  return policy_.cost(report.evaluations - evaluations_before_, report.solutions, report.factorisations);
}

void StepNewton::solve(SchemeStep& step, StepReport& report) {
  evaluations_before_ = report.evaluations;
  wasted_ = 0;
  for (;; improve(step, report)) {
    const bool there = reached(step, report);
    if (there && !beyond_bounds(step.trial())) break;
    if (there || report.iterations == options_.iterations || !finite(report)) {
      within_tolerance();
      report.refusal = refusal(step, report);
      factored_for_ = 0;
      break;
    }
  }
  if (report.converged()) {
    // A residual far below the tolerance is harmless.
    constexpr double little = 0.03;
    if (policy_.ever_reuses() && convergence_.worst_ratio() > little) polish(step, report);
    step.check_turns();
    if (!policy_.judge(wasted_, spent(report), report.factorisations)) factored_for_ = 0;
  }
  report.worst_equation = convergence_.worst_equation();
  report.worst_residual = convergence_.worst_residual();
  report.worst_ratio = convergence_.worst_ratio();
}

std::string StepNewton::refusal(const SchemeStep& step, const StepReport& report) const {
  if (searches_ && !search_->why().empty()) return fmt::format("t = {:.6g} s: {}", step.trial().time, search_->why());
  return fmt::format("t = {:.6g} s: Newton did not converge (iterations: {}); largest residual: {}", step.trial().time,
                     report.iterations, convergence_.worst());
}

bool StepNewton::beyond_bounds(const State& trial) {
  if (system_.algebraic().empty()) return false;
  if (!search_) search_ = std::make_unique<BalanceSearch>(system_);
  return search_->beyond_bounds(trial);
}

bool StepNewton::search_balances(bool wanted) {
  if (!search_) search_ = std::make_unique<BalanceSearch>(system_);
  searches_ = wanted && !search_->empty();
  factored_for_ = 0;
  return searches_;
}

void StepNewton::explain(SchemeStep& step, StepReport& report) {
  factored_for_ = 0;
  h_ = step.trial_size();
  if (report.iterations <= 1) return;
  within_tolerance();
  report.refusal += "; before the iteration went there the largest residual was: " + convergence_.worst();
}

/// Tries shorter steps if a full one has increased the residual above `before` or could not be evaluated, and keeps one
/// that reduces it.
void StepNewton::shorten(SchemeStep& step, double before, std::exception_ptr refusal, StepReport& report) {
  const double full = size_;
  double part = 1;
  for (const double shorter : {0.5, 0.25, 0.125}) {
    move_and_follow(step, shorter - part);
    part = shorter;
    try {
      evaluate(step, report);
      size_ = size_of_residual();
    } catch (const ComputationError&) {
      continue;
    }
    if (size_ < before) {
      ++report.shortened;
      return;
    }
  }
  if (refusal) {
    move_and_follow(step, -part);
    evaluate(step, report);
    std::rethrow_exception(refusal);
  }
  // Newton's method may have to increase the residual temporarily.
  move_and_follow(step, 1 - part);
  evaluate(step, report);
  size_ = full;
}

/// Adds a step with the last factors. If forces have kinks, it is taken back unless the residual decreases: the tangent
/// may belong to the other side.
void StepNewton::polish(SchemeStep& step, StepReport& report) {
  solve_with_factors(report);
  equations_->move(step, delta_, 1);
  if (!system_.has_kinks()) {
    step.show();
    return;
  }
  const double before = size_of_residual();
  try {
    evaluate(step, report);
    if (size_of_residual() <= before) return;
  } catch (const ComputationError&) {
    // the corrected state cannot be evaluated
  }
  move_and_follow(step, -1);
  evaluate(step, report);
}

/// Makes one iteration of Newton's method.
void StepNewton::improve(SchemeStep& step, StepReport& report) {
  // Old factors are not the cause of slow convergence late in a difficult step.
  const bool renew = (report.iterations == 0 ? policy_.renews_at_start() : !policy_.ever_reuses()) ||
                     !same_size(step.trial_size(), factored_for_, factors_serve_within_) ||
                     report.iterations >= options_.iterations / 2;
  if (renew) factor(step, report);
  if (renew || report.iterations == 0) convergence_.measure_terms(equations_->linear(), step.trial());
  if (report.iterations == 0) {
    convergence_.measure_by(scale_);
    measures_ = true;
    size_ = size_of_residual();
  }
  solve_with_factors(report);
  ++report.iterations;
  const double before = size_before_ = size_;
  equations_->move(step, delta_, 1);
  std::exception_ptr refusal;
  try {
    evaluate(step, report);
    size_ = size_of_residual();
  } catch (const ComputationError&) {
    // A component cannot be evaluated (a beam whose ends rotate too far).
    if (renew && !options_.line_search) throw;
    refusal = std::current_exception();
    size_ = std::numeric_limits<double>::infinity();
  }
  if (!renew && !policy_.worthwhile(before, size_)) {
    factored_for_ = 0;
    if (size_ < before) return;
    // The old tangent gave a wrong direction.
    move_and_follow(step, -1);
    evaluate(step, report);
    size_ = size_of_residual();
    return;
  }
  // Even new factors are soon useless if the solution is far away; they are then not reused.
  if (renew && !policy_.worthwhile(before, size_)) factored_for_ = 0;
  if (options_.line_search && !(size_ <= before)) shorten(step, before, refusal, report);
}

bool StepNewton::reached(const SchemeStep& step, const StepReport& report) {
  if (report.iterations == 0) return false;
  // If the residual does not decrease any more, it may be rounding.
  const bool stalled = report.iterations >= 3 && !(size_ < 0.5 * size_before_);
  if (!stalled && convergence_.out_of_reach(size_, scale_)) return false;
  if (within_tolerance()) return true;
  // The forces may have grown since their rounding was measured.
  if (!stalled || floor_age_ == 0) return false;
  convergence_.measure_rounding(equations_->linear(), step.trial());
  floor_age_ = 0;
  return within_tolerance();
}

bool StepNewton::within_tolerance() { return convergence_.reached(equations_->judged(r_, h_), scale_); }

/// Returns whether the residual is finite. After the first iteration its size is checked, which is infinite if an entry
/// is not a number.
bool StepNewton::finite(const StepReport& report) const {
  return report.iterations == 0 ? r_.allFinite() : std::isfinite(size_);
}

}  // namespace bielle::mechanism
