// Velocities across the constraints: the part of v_n that the scheme of index 3 has for its own.
//
// The scheme keeps Phi(q) = 0 and not B v = 0. Its smooth solution has
//     B v_n = h^2 B c + O(h^3),   c = C_q j + [0; Omega x Omegadot]/12,   j = (A_n - A_{n-1})/h,
// and a motion that starts without that offset gets multipliers of first order (M. Arnold, O. Bruls, A. Cardona, Numer.
// Math. 129 (2015) 149). Left to itself, what v and A have across a constraint follows from Dq = 0 there:
//     beta z^2 + (1/2 + gamma - 2 beta) z + 1/2 - gamma + beta = 0,    z = -rho twice,
// however small the step: errors alternate and fade by rho per step. While the constraint turns by epsilon per step,
// the double root splits into about rho (1 + epsilon): from a turn of some 0.7 ln(1/rho) on, 0.154 with rho = 0.8,
// errors of constraint forces grow until nothing is left of the motion. With rho = 1 (Newmark) they grow at any step.
//
// Where velocities across the constraints are given the offset after each step, v no longer carries anything over from
// step to step, and there remains
//     beta z^2 + (1/2 - beta + C_q) z - C_q = 0,    |z| = sqrt(-C_q/beta) <= 0.58 for every rho.
// A constraint that turns then does no harm. Positions and accelerations of the step stay as they are. The correction
// costs a factorisation of [M B^T; B 0]: it begins with the first step in which a constraint turns by half the limit,
// and goes on from there. (Not now and then: where A holds an error that alternates, a single correction stirs it up.)
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/model_length.hpp"
#include "mechanism/solvers/time_integration.hpp"

namespace bielle::mechanism {

/// B c: what the constraint rates change by when the accelerations change by c.
VectorX TimeIntegration::velocity_target(const State& state, const VectorX& v, const VectorX& a,
                                         const VectorX& j) const {
  VectorX c = scheme_.position_error() * j;
  for (std::size_t i = 0; i < state.nodes.size(); ++i) {
    const NodeFreedom& f = system_.kinematics().freedom(static_cast<int>(i));
    if (f.rotations == 3)
      c.segment<3>(f.begin + f.count - 3) += state.nodes[i].Omega.cross(state.nodes[i].Omegadot) / 12;
  }
  VectorX velocity(system_.multipliers()), with(system_.multipliers()), without(system_.multipliers());
  State moved = state;
  system_.set_rates(moved, v, a + c);
  system_.constraint_rates(moved, environment_, velocity, with);
  system_.constraint_rates(state, environment_, velocity, without);
  VectorX target = with - without;
  // What relates velocities holds for those of the scheme as they are.
  for (int k = 0; k < system_.multipliers(); ++k)
    if (system_.constraint_kind(k) != ConstraintKind::holonomic) target[k] = 0;
  system_.for_each_idle(state, [&](int k) { target[k] = 0; });
  return target;
}

/// What changes the least in the kinetic energy's norm, so that the constraint rates become smaller by r's last rows.
VectorX TimeIntegration::across_constraints(const State& state) {
  if (!saddle_.serves()) saddle_.factor(environment_, state);
  saddle_.solve(r_.head(system_.size()), delta_.head(system_.size()));
  return delta_.head(system_.dofs());
}

void TimeIntegration::perturb_velocity(const VectorX& j, double factor) {
  if (system_.multipliers() == 0 || stabilised_) return;
  r_.setZero();
  r_.tail(system_.multipliers()) = -factor * velocity_target(state_, v_, a_, j);
  v_ += across_constraints(state_);
}

double TimeIntegration::turn_of_constraints() const {
  // Directions of constraints turn with their nodes, or with the line from one node to the other.
  const double length = model_length(next_), rounding = 1e-12 * length * length;
  double rate = 0;  // squared
  for (const Slots& slots : system_.slots()) {
    if (slots.multipliers == 0 || slots.nodes.empty()) continue;
    const NodeState& first = next_.nodes[static_cast<std::size_t>(slots.nodes[0])];
    rate = std::max(rate, first.Omega.squaredNorm());
    for (std::size_t k = 1; k < slots.nodes.size(); ++k) {
      const NodeState& node = next_.nodes[static_cast<std::size_t>(slots.nodes[k])];
      rate = std::max(rate, node.Omega.squaredNorm());
      const Vector3 line = node.x - first.x;
      const double distance = line.squaredNorm(), turn = line.cross(node.v - first.v).squaredNorm();
      if (distance > rounding && turn > rate * distance * distance) rate = turn / (distance * distance);
    }
  }
  return std::sqrt(rate) * attempted_;
}

void TimeIntegration::correct_velocity() {
  const int m = system_.multipliers();
  const double h = attempted_;
  VectorX rate(m), unused(m);
  system_.constraint_rates(next_, environment_, rate, unused);
  for (int k = 0; k < m; ++k)
    if (system_.constraint_kind(k) != ConstraintKind::holonomic) rate[k] = 0;
  system_.for_each_idle(next_, [&](int k) { rate[k] = 0; });
  r_.setZero();
  r_.tail(m) = rate - h * h * velocity_target(next_, v_new_, a_new_, j_);
  saddle_.serve_no_more();
  v_new_ += across_constraints(next_);
  saddle_.serve_no_more();
  system_.set_rates(next_, v_new_, a_new_);
}

void TimeIntegration::watch_turns() {
  if (system_.multipliers() == 0) return;
  turn_ = turn_of_constraints();
  if (form_ != ConstraintForm::corrected) return;
  if (!turning_) turning_ = turn_ > 0.5 * scheme_.most_turn();
  if (turning_) correct_velocity();
}

std::string TimeIntegration::caution() const {
  // The stabilised form bears at least seven times as much: 0.55 rad with rho = 0.95, 1.1 with 0.8 (linearised, too).
  const double most = (form_ == ConstraintForm::stabilised ? 7 : 1) * scheme_.most_turn();
  const std::string turns =
      fmt::format("t = {:.6g} s: a joint turns by {:.2g} rad in a step of {:.3g} s", state_.time, turn_, h_);
  constexpr double none = 1e-6;
  if (form_ != ConstraintForm::corrected && turn_ > std::max(most, none))
    return fmt::format(
        "{}; with this scheme and form of constraints, errors of joint forces may grow from {:.2g} rad on: take "
        "smaller steps, or `constraints: corrected` (the default)",
        turns, most);
  const double lag = -scheme_.position_error() * turn_ * turn_;
  if (lag > 0.01)
    return fmt::format(
        "{}; such steps are stable, but positions fall behind by about {:.1g} of each turn: take smaller ones, or give "
        "a `tolerance`",
        turns, lag);
  return {};
}

}  // namespace bielle::mechanism
