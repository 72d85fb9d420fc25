#include "mechanism/solvers/dynamics/scheme_step.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mechanism/math/so3.hpp"
#include "mechanism/system/check_state.hpp"

namespace bielle::mechanism {

SchemeStep::SchemeStep(const System& system, const Scheme& scheme, State state)
    : system_(system), scheme_(scheme), state_(std::move(state)), trial_(state_) {
  for (VectorX* vector : {&rates_.v, &rates_.a, &rates_.A, &rates_.j, &dq_, &v_, &a_, &last_dq_})
    vector->setZero(system.dofs());
  rates_.Y = state_.first_order_rate;
  rates_.Y_rate.setZero(system.first_orders());
}

void SchemeStep::exchange(Archive& archive) {
  archive(state_);
  for (VectorX* vector : {&rates_.v, &rates_.a, &rates_.A, &rates_.j, &rates_.Y, &rates_.Y_rate}) archive(*vector);
  archive(rates_.Y_rate_known);
  archive(size_);
  if (!archive.restoring()) return;
  check_state(system_, state_);
  trial_ = state_;
}

void SchemeStep::take_rates() {
  system_.get_rates(state_, rates_.v, rates_.a);
  rates_.A = rates_.a;
  rates_.Y = state_.first_order_rate;
  rates_.Y_rate_known = false;
}

void SchemeStep::get_highest(VectorX& values) const {
  const int n = system_.dofs(), y = system_.first_orders();
  values.resize(system_.size());
  values.head(n) = rates_.a;
  values.segment(n, y) = state_.first_order_rate;
  for (const int k : system_.algebraic()) values[n + k] = state_.first_order[k];
  values.tail(system_.multipliers()) = state_.multiplier;
}

// -- the trial

void SchemeStep::calc_end(const VectorX& a, const VectorX& rate, VectorX& dq, VectorX& v, VectorX& y) const {
  const auto& [alpha_m, alpha_f, gamma, beta] = scheme_;
  const double h = trial_size_;
  const auto A = ((1 - alpha_f) * a + alpha_f * rates_.a - alpha_m * rates_.A) / (1 - alpha_m);
  const auto Y = ((1 - alpha_f) * rate + alpha_f * state_.first_order_rate - alpha_m * rates_.Y) / (1 - alpha_m);
  dq = h * rates_.v + h * h * ((0.5 - beta) * rates_.A + beta * A);
  v = rates_.v + h * ((1 - gamma) * rates_.A + gamma * A);
  y = state_.first_order + h * ((1 - gamma) * rates_.Y + gamma * Y);
}

/// Undoes the extrapolation of algebraic unknowns whose entries are released: they keep their values.
static void keep_released(const System& system, const State& before, State& trial) {
  const std::vector<int>& algebraic = system.algebraic();
  for (std::size_t m = 0; m < system.slots().size(); ++m) {
    const Slots& slots = system.slots()[m];
    if (slots.first_orders == 0 || system.is_active(before, m)) continue;
    for (int k = slots.first_order_begin; k < slots.first_order_begin + slots.first_orders; ++k)
      if (std::binary_search(algebraic.begin(), algebraic.end(), k)) trial.first_order[k] = before.first_order[k];
  }
}

void SchemeStep::begin(double h, double end, const VectorX& highest) {
  const auto& [alpha_m, alpha_f, gamma, beta] = scheme_;
  const int n = system_.dofs();
  trial_size_ = h;
  rate_factor_ = gamma / (beta * h);
  acceleration_factor_ = (1 - alpha_m) / ((1 - alpha_f) * beta * h * h);
  first_order_factor_ = (1 - alpha_m) / ((1 - alpha_f) * gamma * h);
  a_ = highest.head(n);
  trial_.first_order_rate = highest.segment(n, system_.first_orders());
  still_algebraic();
  calc_end(a_, trial_.first_order_rate, dq_, v_, trial_.first_order);
  for (const int k : system_.algebraic()) trial_.first_order[k] = highest[n + k];
  if (!system_.algebraic().empty() && system_.activities().any()) keep_released(system_, state_, trial_);
  trial_.multiplier = highest.tail(system_.multipliers());
  trial_.time = end;
  trial_.memory = state_.memory;
  trial_.idle = state_.idle;
}

void SchemeStep::move(const VectorX& delta_of_all, double part) {
  const int n = system_.dofs(), y = system_.first_orders(), m = system_.multipliers();
  const double to_rate = part * rate_factor_, to_acceleration = part * acceleration_factor_;
  const double* __restrict delta = delta_of_all.data();
  double* __restrict dq = dq_.data(), * __restrict v = v_.data(), * __restrict a = a_.data();
  for (int i = 0; i < n; ++i) {  // in one pass, because the first-level cache is small
    dq[i] += part * delta[i];
    v[i] += to_rate * delta[i];
    a[i] += to_acceleration * delta[i];
  }
  trial_.first_order += part * delta_of_all.segment(n, y);
  trial_.first_order_rate += part * first_order_factor_ * delta_of_all.segment(n, y);
  still_algebraic();
  trial_.multiplier += part * delta_of_all.segment(n + y, m);
}

void SchemeStep::follow(const VectorX* without_rates) {
  calc_end(rates_.a, state_.first_order_rate, dq_0_, v_0_, y_0_);
  dq_0_ = dq_ - dq_0_;
  if (without_rates) dq_0_ -= *without_rates;
  v_ = v_0_ + rate_factor_ * dq_0_;
  a_ = rates_.a + acceleration_factor_ * dq_0_;
  trial_.first_order_rate = state_.first_order_rate + first_order_factor_ * (trial_.first_order - y_0_);
  still_algebraic();
}

/// Sets the rates of algebraic unknowns, which have none, to zero.
void SchemeStep::still_algebraic() {
  for (const int k : system_.algebraic()) trial_.first_order_rate[k] = 0;
}

void SchemeStep::show() {
  system_.displace(trial_, state_, dq_);
  system_.set_rates(trial_, v_, a_);
}

void SchemeStep::set_trial_velocity(const VectorX& v) {
  v_ = v;
  system_.set_rates(trial_, v_, a_);
}

void SchemeStep::set_trial(State trial, double h, const VectorX& dq) {
  trial_ = std::move(trial);
  trial_size_ = h;
  dq_ = dq;
  system_.get_rates(trial_, v_, a_);
}

template <class Act>
void SchemeStep::for_each_rotation(const Act& act) const {
  for (std::size_t node = 0; node < state_.nodes.size(); ++node) {
    const NodeFreedom& f = system_.kinematics().freedom(static_cast<int>(node));
    if (f.rotations == 3) act(node, f.begin + f.count - 3);
  }
}

void SchemeStep::check_turns() const {
  constexpr double most_turn = 0.9 * 2 * 3.14159265358979324;  // [rad]
  if (dq_.lpNorm<Eigen::Infinity>() < most_turn / 2) return;   // the usual case
  for_each_rotation([&](std::size_t node, int k) {
    if (const double turn = dq_.segment<3>(k).norm(); turn > most_turn)
      throw ComputationError(fmt::format(
          "t = {:.6g} s: node '{}' turns by {:.3g} rad in one step of {:.3g} s; the scheme needs less than {:.3g} rad",
          trial_.time, system_.model().node(static_cast<int>(node)).name, turn, trial_size_, most_turn));
  });
}

// -- acceptance

VectorX SchemeStep::algorithmic_acceleration() const {
  const auto& [alpha_m, alpha_f, gamma, beta] = scheme_;
  return ((1 - alpha_f) * a_ + alpha_f * rates_.a - alpha_m * rates_.A) / (1 - alpha_m);
}

VectorX SchemeStep::algorithmic_rate() const {
  const auto& [alpha_m, alpha_f, gamma, beta] = scheme_;
  return ((1 - alpha_f) * trial_.first_order_rate + alpha_f * state_.first_order_rate - alpha_m * rates_.Y) /
         (1 - alpha_m);
}

void SchemeStep::take_algorithmic_values() {
  const VectorX A = algorithmic_acceleration(), Y = algorithmic_rate();
  rates_.j = (A - rates_.A) / trial_size_;
  rates_.Y_rate = (Y - rates_.Y) / trial_size_;
  rates_.Y_rate_known = true;
  rates_.A = A;
  rates_.Y = Y;
}

void SchemeStep::accept() {
  rates_.v.swap(v_);
  rates_.a.swap(a_);
  last_dq_.swap(dq_);
  size_ = trial_size_;
  std::swap(state_, trial_);
}

// -- errors and interpolation

VectorX SchemeStep::position_error() const {
  const double h = trial_size_;
  VectorX error = scheme_.position_error() * h * h * (algorithmic_acceleration() - rates_.A);
  for_each_rotation([&](std::size_t node, int k) {
    error.segment<3>(k) += h * h * h / 12 * trial_.nodes[node].Omega.cross(trial_.nodes[node].Omegadot);
  });
  return error;
}

VectorX SchemeStep::first_order_error() const {
  const double h = trial_size_;
  if (!rates_.Y_rate_known) return VectorX::Zero(system_.first_orders());
  const VectorX rate = (algorithmic_rate() - rates_.Y) / h;
  // The two rates belong to the middles of the two steps.
  return scheme_.velocity_error() * h * h * h * (rate - rates_.Y_rate) / (0.5 * (h + size_));
}

State SchemeStep::interpolated(double time) const {
  const State &before = trial_, &after = state_;
  const double h = after.time - before.time, s = (time - before.time) / h;
  // Cubic polynomials in the chart of the step, from the values and rates at its ends.
  const double f0 = s * (1 - s) * (1 - s), f1 = s * s * (3 - 2 * s), f2 = s * s * (s - 1);
  const double d0 = (1 - s) * (1 - 3 * s), d1 = 6 * s * (1 - s), d2 = s * (3 * s - 2);
  VectorX v_before(system_.dofs()), a_before(system_.dofs());
  system_.get_rates(before, v_before, a_before);
  VectorX end_rate = rates_.v;
  for_each_rotation([&](std::size_t, int k) {
    end_rate.segment<3>(k) = tangent_inverse(last_dq_.segment<3>(k)) * rates_.v.segment<3>(k);
  });
  const VectorX dq = f0 * h * v_before + f1 * last_dq_ + f2 * h * end_rate;
  VectorX v = d0 * v_before + d1 / h * last_dq_ + d2 * end_rate;
  for_each_rotation(
      [&](std::size_t, int k) { v.segment<3>(k) = tangent(dq.segment<3>(k)) * Vector3(v.segment<3>(k)); });

  State state = before;
  state.time = time;
  system_.displace(state, before, dq);
  system_.set_rates(state, v, (1 - s) * a_before + s * rates_.a);
  state.first_order = before.first_order + f0 * h * before.first_order_rate +
                      f1 * (after.first_order - before.first_order) + f2 * h * after.first_order_rate;
  for (const int k : system_.algebraic())
    state.first_order[k] = (1 - s) * before.first_order[k] + s * after.first_order[k];
  state.first_order_rate = (1 - s) * before.first_order_rate + s * after.first_order_rate;
  state.multiplier = (1 - s) * before.multiplier + s * after.multiplier;
  state.reaction.resize(0);
  if (before.reaction.size() > 0 || after.reaction.size() > 0) {
    const auto read = [](const State& at) { return at.reaction.size() > 0 ? at.reaction : at.multiplier; };
    state.reaction = (1 - s) * read(before) + s * read(after);
  }
  return state;
}

}  // namespace bielle::mechanism
