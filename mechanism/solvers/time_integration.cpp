#include "mechanism/solvers/time_integration.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/redundancy.hpp"

namespace bielle::mechanism {

Scheme Scheme::generalized_alpha(double rho) {
  if (!(rho >= 0 && rho <= 1)) throw InputError(fmt::format("rho = {} is outside of [0, 1]", rho));
  Scheme s{(2 * rho - 1) / (rho + 1), rho / (rho + 1), 0, 0};
  s.gamma = 0.5 + s.alpha_f - s.alpha_m;
  s.beta = 0.25 * (s.gamma + 0.5) * (s.gamma + 0.5);
  return s;
}

Scheme Scheme::hht(double alpha) {
  if (!(alpha >= 0 && alpha <= 1.0 / 3)) throw InputError(fmt::format("alpha = {} is outside of [0, 1/3]", alpha));
  return {0, alpha, 0.5 + alpha, 0.25 * (1 + alpha) * (1 + alpha)};
}

Scheme Scheme::newmark() { return {0, 0, 0.5, 0.25}; }

TimeIntegration::TimeIntegration(const System& system, const Environment& environment, const Scheme& scheme,
                                 State state, const NewtonOptions& options)
    : system_(system),
      environment_(environment),
      scheme_(scheme),
      state_(std::move(state)),
      linear_(system),
      options_(options),
      convergence_(system, options) {
  start_report_ = make_consistent(system_, environment_, state_);
  const int n = system.dofs();
  for (VectorX* vector : {&v_, &a_, &A_, &dq_, &v_new_, &a_new_, &A_new_}) vector->setZero(n);
  r_.setZero(system.size());
  delta_.setZero(system.size());
  system_.get_rates(state_, v_, a_);
  A_ = a_;
  Y_ = state_.first_order_rate;
  Y_new_ = Y_;
  system_.accept(state_, environment_);
  next_ = state_;
}

VectorX TimeIntegration::acceleration_rate(double h) {
  // Forward differences of the consistent accelerations along the motion: functions of time may not exist before the
  // start. The step has to be small beside h only.
  const double e = 0.05 * h;
  VectorX ahead[2];
  for (const int k : {1, 2}) {
    State shifted = state_;
    shifted.time = state_.time + k * e;
    system_.displace(shifted, state_, k * e * v_ + 0.5 * k * k * e * e * a_);
    system_.set_rates(shifted, v_ + k * e * a_, a_);
    shifted.first_order = state_.first_order + k * e * state_.first_order_rate;
    make_accelerations_consistent(system_, environment_, shifted);
    VectorX unused(system_.dofs());
    ahead[k - 1].resize(system_.dofs());
    system_.get_rates(shifted, unused, ahead[k - 1]);
  }
  return (4 * ahead[0] - ahead[1] - 3 * a_) / (2 * e);
}

bool TimeIntegration::resolved(const VectorX& j, double h) const {
  std::array<double, kind_count> acceleration{}, change{};
  for (int i = 0; i < system_.dofs(); ++i) {
    const auto kind = static_cast<std::size_t>(system_.kind(i));
    acceleration[kind] = std::max(acceleration[kind], std::abs(a_[i]));
    change[kind] = std::max(change[kind], std::abs(h * j[i]));
  }
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    if (change[kind] > acceleration[kind]) return false;
  return true;
}

void TimeIntegration::perturb_velocity(const VectorX& j, double factor) {
  if (system_.multipliers() == 0) return;
  const double delta = scheme_.delta();
  VectorX c = -(1 + 3 * delta * delta) / 12 * j;
  for (std::size_t i = 0; i < state_.nodes.size(); ++i) {
    const NodeFreedom& f = system_.kinematics().freedom(static_cast<int>(i));
    if (f.rotations == 3)
      c.segment<3>(f.begin + f.count - 3) += state_.nodes[i].Omega.cross(state_.nodes[i].Omegadot) / 12;
  }
  // B c is the change of the constraint rates when the accelerations change by c.
  VectorX velocity(system_.multipliers()), with(system_.multipliers()), without(system_.multipliers());
  State moved = state_;
  system_.set_rates(moved, v_, a_ + c);
  system_.constraint_rates(moved, environment_, velocity, with);
  system_.constraint_rates(state_, environment_, velocity, without);
  r_.setZero();
  r_.tail(system_.multipliers()) = without - with;
  for (const int multiplier : system_.set_aside()) r_[system_.size() - system_.multipliers() + multiplier] = 0;
  factor_mass_saddle(system_, environment_, state_, linear_);
  linear_.solve(r_, delta_);
  v_ += factor * delta_.head(system_.dofs());
}

void TimeIntegration::start(double h) {
  const VectorX j = acceleration_rate(h);
  // The corrections are terms of a series in h. Where the accelerations change by their own size within a step (stiff
  // bodies set off suddenly), they would add what the scheme then has to damp.
  if (!resolved(j, h)) return;
  A_ = a_ + scheme_.delta() * h * j;
  perturb_velocity(j, h * h);
  system_.set_rates(state_, v_, a_);
}

StepReport TimeIntegration::step(double h) {
  const auto [alpha_m, alpha_f, gamma, beta] = scheme_;
  const double rate_factor = gamma / (beta * h);                                      // gamma'
  const double acceleration_factor = (1 - alpha_m) / ((1 - alpha_f) * beta * h * h);  // beta'
  const double first_order_factor = (1 - alpha_m) / ((1 - alpha_f) * gamma * h);
  const TangentWeights weights{1, rate_factor, acceleration_factor, first_order_factor, 1};
  const int n = system_.dofs(), y = system_.first_orders(), m = system_.multipliers();

  // Predict: the accelerations stay.
  a_new_ = a_;
  A_new_ = ((1 - alpha_f) * a_new_ + alpha_f * a_ - alpha_m * A_) / (1 - alpha_m);
  dq_ = h * v_ + h * h * ((0.5 - beta) * A_ + beta * A_new_);
  v_new_ = v_ + h * ((1 - gamma) * A_ + gamma * A_new_);
  next_.time = state_.time + h;
  next_.multiplier = state_.multiplier;
  next_.memory = state_.memory;
  next_.first_order_rate = state_.first_order_rate;
  Y_new_ = (next_.first_order_rate * (1 - alpha_f) + alpha_f * state_.first_order_rate - alpha_m * Y_) / (1 - alpha_m);
  next_.first_order = state_.first_order + h * ((1 - gamma) * Y_ + gamma * Y_new_);

  StepReport report;
  ResidualScale scale;
  for (;; ++report.iterations) {
    system_.displace(next_, state_, dq_);
    system_.set_rates(next_, v_new_, a_new_);
    system_.residual(next_, environment_, r_, &scale);
    if (report.iterations > 0 && convergence_.reached(r_, scale)) break;
    if (report.iterations == options_.iterations || !r_.allFinite()) {
      convergence_.reached(r_, scale);
      throw ComputationError(fmt::format("t = {:.6g} s: Newton did not converge in {} iterations; largest residual: {}",
                                         next_.time, report.iterations, convergence_.worst()));
    }
    linear_.factor(next_, environment_, weights, &dq_);
    if (report.iterations == 0) convergence_.measure_rounding(linear_, next_);
    linear_.solve(r_, delta_);
    dq_ += delta_.head(n);
    v_new_ += rate_factor * delta_.head(n);
    a_new_ += acceleration_factor * delta_.head(n);
    next_.first_order += delta_.segment(n, y);
    next_.first_order_rate += first_order_factor * delta_.segment(n, y);
    next_.multiplier += delta_.tail(m);
  }
  report.worst_ratio = convergence_.worst_ratio();
  check_set_aside(system_, environment_, next_);

  A_ = ((1 - alpha_f) * a_new_ + alpha_f * a_ - alpha_m * A_) / (1 - alpha_m);
  Y_ = ((1 - alpha_f) * next_.first_order_rate + alpha_f * state_.first_order_rate - alpha_m * Y_) / (1 - alpha_m);
  v_ = v_new_;
  a_ = a_new_;
  system_.accept(next_, environment_);
  std::swap(state_, next_);
  return report;
}

}  // namespace bielle::mechanism
