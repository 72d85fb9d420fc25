// Newton's method within an attempted step of TimeIntegration.
#include <cmath>
#include <exception>
#include <limits>

#include "mechanism/solvers/time_integration.hpp"

namespace bielle::mechanism {
namespace {

/// Steps after which the rounding of residuals is measured again.
constexpr int floor_lasts = 64;

/// Whether old factors will do: at the rate at which they brought a residual from `before` to `now` (over its
/// tolerance), they need no more further iterations than a factorisation costs.
bool worthwhile(double before, double now) {
  constexpr double slowest = 0.5, iterations_per_factorisation = 4;
  return now < slowest * before && std::log(now) < iterations_per_factorisation * std::log(before / now);
}

}  // namespace

void TimeIntegration::move(double part) {
  const int n = system_.dofs(), y = system_.first_orders(), m = system_.multipliers();
  const double to_rate = part * rate_factor_, to_acceleration = part * acceleration_factor_;
  const double* __restrict delta = delta_.data();
  double* __restrict dq = dq_.data(), * __restrict v = v_new_.data(), * __restrict a = a_new_.data();
  for (int i = 0; i < n; ++i) {  // in one pass: the nearest cache does not hold the vectors for long
    dq[i] += part * delta[i];
    v[i] += to_rate * delta[i];
    a[i] += to_acceleration * delta[i];
  }
  next_.first_order += part * delta_.segment(n, y);
  next_.first_order_rate += part * first_order_factor_ * delta_.segment(n, y);
  still_algebraic();
  next_.multiplier += part * delta_.segment(n + y, m);
  if (stabilised_) {
    const auto change = part * delta_.segment(system_.size(), n);
    eta_ += change;
    dq_ += change;
    mu_ += part * delta_.tail(m);
  }
}

/// Moves the attempt where it has been far off. A way there and back leaves rounding of its own size in increments and
/// rates, and Newton's method, which moves them together, would never take out what they then lack of the scheme's
/// relations: the rates are made those of the increments again.
void TimeIntegration::move_and_follow(double part) {
  move(part);
  VectorX dq, v, y;
  calc_prediction(attempted_, dq, v, y);
  dq = dq_ - eta_ - dq;
  v_new_ = v + rate_factor_ * dq;
  a_new_ = a_ + acceleration_factor_ * dq;
  next_.first_order_rate = state_.first_order_rate + first_order_factor_ * (next_.first_order - y);
  still_algebraic();
}

/// Algebraic unknowns have no rates.
void TimeIntegration::still_algebraic() {
  for (const int k : system_.algebraic()) next_.first_order_rate[k] = 0;
}

void TimeIntegration::evaluate() {
  system_.displace(next_, state_, dq_);
  system_.set_rates(next_, v_new_, a_new_);
  ResidualScale scale;
  reactions_.balance(environment_, next_);
  system_.residual(next_, environment_, r_evaluated_.head(system_.size()), &scale);
  if (stabilised_) stabilised_->add_residual(next_, environment_, eta_, mu_, r_evaluated_);
  r_.swap(r_evaluated_);
  scale_ = scale;
}

double TimeIntegration::size_of_residual() const { return convergence_.size_of(r_.head(system_.size())); }

void TimeIntegration::factor(StepReport& report) {
  const TangentWeights weights{1, rate_factor_, acceleration_factor_, first_order_factor_, 1};
  factored_for_ = 0;
  if (stabilised_) {
    linear_.assemble(next_, environment_, weights, &dq_);
    if (!stabilised_->factor(linear_, next_, environment_, weights, dq_)) linear_.throw_singular(next_.time);
  } else {
    linear_.factor(next_, environment_, weights, &dq_);
  }
  factored_for_ = attempted_;
  ++report.factorisations;
  if (floor_age_ < floor_lasts && same_size(h_, attempted_)) return;
  convergence_.measure_rounding(linear_, next_);
  floor_age_ = 0;
}

/// Where a full step made the residual larger than it was `before`, or was refused: shorter ones, if they make it
/// smaller.
void TimeIntegration::shorten(double before, std::exception_ptr refusal, StepReport& report) {
  const double full = size_;
  double part = 1;
  for (const double shorter : {0.5, 0.25, 0.125}) {
    move_and_follow(shorter - part);
    part = shorter;
    try {
      evaluate();
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
    move_and_follow(-part);
    evaluate();
    std::rethrow_exception(refusal);
  }
  // Newton's method may have to pass over a hill.
  move_and_follow(1 - part);
  evaluate();
  size_ = full;
}

void TimeIntegration::solve() {
  if (stabilised_)
    stabilised_->solve(r_, delta_);
  else
    linear_.solve(r_, delta_);
}

/// What is left within the tolerance is taken out once more: a tangent that is not of this iterate leaves a residual of
/// the tolerance's size, of the same sign step after step. Where forces have kinks, that tangent may be of the other
/// side: there the residual has to become smaller indeed.
void TimeIntegration::polish() {
  solve();
  move(1);
  if (!system_.has_kinks()) {
    system_.displace(next_, state_, dq_);
    system_.set_rates(next_, v_new_, a_new_);
    return;
  }
  const double before = size_of_residual();
  try {
    evaluate();
    if (size_of_residual() <= before) return;
  } catch (const ComputationError&) {
    // refused: not there, then
  }
  move_and_follow(-1);
  evaluate();
}

/// An iteration of Newton's method.
void TimeIntegration::improve(StepReport& report) {
  // Late in a step that is hard to solve, old factors are not to blame.
  const bool renew =
      !options_.reuse_tangent || !same_size(attempted_, factored_for_, factors_serve_within_) || report.iterations >= options_.iterations / 2;
  if (renew) factor(report);
  if (renew || report.iterations == 0) convergence_.measure_terms(linear_, next_);
  if (report.iterations == 0) {
    convergence_.measure_by(scale_);
    size_ = size_of_residual();
  }
  solve();
  ++report.iterations;
  const double before = size_before_ = size_;
  move(1);
  std::exception_ptr refusal;
  try {
    evaluate();
    size_ = size_of_residual();
  } catch (const ComputationError&) {
    // A component refuses what it is asked for (a beam whose ends turn too far).
    if (renew && !options_.line_search) throw;
    refusal = std::current_exception();
    size_ = std::numeric_limits<double>::infinity();
  }
  if (!renew && !worthwhile(before, size_)) {
    factored_for_ = 0;
    if (size_ < before) return;
    // The old tangent led astray.
    move_and_follow(-1);
    evaluate();
    size_ = size_of_residual();
    return;
  }
  if (options_.line_search && !(size_ <= before)) shorten(before, refusal, report);
}

bool TimeIntegration::reached(const StepReport& report) {
  if (report.iterations == 0) return false;
  // Where nothing more is gained, what is left may be rounding.
  const bool stalled = report.iterations >= 3 && !(size_ < 0.5 * size_before_);
  if (!stabilised_ && !stalled && convergence_.out_of_reach(size_, scale_)) return false;
  if (within_tolerance()) return true;
  // The forces may have grown since their rounding was measured.
  if (!stalled || floor_age_ == 0) return false;
  convergence_.measure_rounding(linear_, next_);
  floor_age_ = 0;
  return within_tolerance();
}

/// No number among the residuals makes their size infinite; of what stabilises, and before the first iteration, there
/// is no size.
bool TimeIntegration::finite(const StepReport& report) const {
  return report.iterations == 0 || stabilised_ ? r_.allFinite() : std::isfinite(size_);
}

bool TimeIntegration::within_tolerance() {
  if (!stabilised_) return convergence_.reached(r_, scale_);
  // What the rates of constraints make of them within a step is judged like the constraints themselves.
  VectorX r = r_.head(system_.size());
  const int m = system_.multipliers();
  for (int i = 0; i < m; ++i) {
    double& constraint = r[system_.size() - m + i];
    const double rate = attempted_ * r_[r_.size() - m + i];
    if (!(std::abs(rate) <= std::abs(constraint))) constraint = rate;
  }
  return convergence_.reached(r, scale_);
}

}  // namespace bielle::mechanism
