#include "mechanism/solvers/statics/load_ramp.hpp"

namespace bielle::mechanism {

void LoadRamp::set_off(State& state) const {
  const VectorX zero = VectorX::Zero(system_.dofs());
  system_.set_rates(state, zero, zero);
  for (NodeState& node : state.nodes)
    for (Vector3* rate : {&node.v, &node.Omega, &node.a, &node.Omegadot}) rate->setZero();
  state.first_order_rate.setZero();
  state.motion_factor = start_.motions;
  system_.displace(state, State(state), zero);
}

Environment LoadRamp::environment(double factor) const {
  Environment loaded = full_;
  loaded.load_factor = factor;
  loaded.gravity = factor * full_.gravity;
  return loaded;
}

void LoadRamp::factor_derivative(const State& state, double factor, Eigen::Ref<VectorX> result) const {
  // Residuals are linear in loads and gravity.
  VectorX r(system_.size());
  residual_at_rest(system_, environment(factor), state, r);
  residual_at_rest(system_, environment(factor + 1), state, result);
  result -= r;
  if (motion_rate() == 0) return;
  motion_derivative(state, environment(factor), r);
  result += motion_rate() * r;
}

void LoadRamp::motion_derivative(const State& state, const Environment& environment, Eigen::Ref<VectorX> result) const {
  // Rounding of positions relative to this part of a motion, and its square, are both small.
  constexpr double part = 1e-5;
  const VectorX still = VectorX::Zero(system_.dofs());
  VectorX behind(system_.size());
  State moved = state;
  const auto residual_beside = [&](double difference, Eigen::Ref<VectorX> r) {
    moved.motion_factor = state.motion_factor + difference;
    system_.displace(moved, state, still);
    residual_at_rest(system_, environment, moved, r);
  };
  residual_beside(-part, behind);
  residual_beside(part, result);
  result = (result - behind) / (2 * part);
}

void residual_at_rest(const System& system, const Environment& environment, const State& state, Eigen::Ref<VectorX> r,
                      ResidualScale* scale) {
  system.residual(state, environment, r, scale);
  const int first = system.size() - system.multipliers();
  for (int i = 0; i < system.multipliers(); ++i)
    if (system.constraint_kind(i) == ConstraintKind::nonholonomic) r[first + i] = 0;
}

}  // namespace bielle::mechanism
