#include "mechanism/solvers/statics/load_ramp.hpp"

namespace bielle::mechanism {

void LoadRamp::set_off(State& state) const {
  const VectorX zero = VectorX::Zero(system_.dofs());
  system_.set_rates(state, zero, zero);
  for (NodeState& node : state.nodes)
    for (Vector3* rate : {&node.v, &node.Omega, &node.a, &node.Omegadot}) rate->setZero();
  state.first_order_rate.setZero();
  apply_motions(system_, start_.motions, state);
}

Environment LoadRamp::environment(double factor) const {
  Environment loaded = full_;
  loaded.load_factor = factor;
  loaded.gravity = factor * full_.gravity;
  return loaded;
}

void LoadRamp::factor_derivative(const State& state, double factor, Eigen::Ref<VectorX> result) const {
  load_derivative(state, factor, result);
  if (motion_rate() == 0) return;
  VectorX r(system_.size());
  motion_derivative(state, environment(factor), r);
  result += motion_rate() * r;
}

void LoadRamp::load_derivative(const State& state, double factor, Eigen::Ref<VectorX> result) const {
  // Residuals are linear in loads and gravity.
  VectorX r(system_.size());
  residual_at_rest(system_, environment(factor), state, r);
  residual_at_rest(system_, environment(factor + 1), state, result);
  result -= r;
}

void LoadRamp::motion_derivative(const State& state, const Environment& environment, Eigen::Ref<VectorX> result) const {
  // With this fraction of a motion, the rounding of positions and the error of second order are both small.
  constexpr double part = 1e-5;
  VectorX behind(system_.size());
  State moved = state;
  const auto residual_after = [&](double difference, Eigen::Ref<VectorX> r) {
    apply_motions(system_, state.motion_factor + difference, moved);
    residual_at_rest(system_, environment, moved, r);
  };
  residual_after(-part, behind);
  residual_after(part, result);
  result = (result - behind) / (2 * part);
}

void apply_motions(const System& system, double part, State& state) {
  if (state.motion_factor == part) return;
  state.motion_factor = part;
  system.displace(state, State(state), VectorX::Zero(system.dofs()));
}

void residual_at_rest(const System& system, const Environment& environment, const State& state, Eigen::Ref<VectorX> r,
                      ResidualScale* scale) {
  system.residual(state, environment, r, scale);
  const int first = system.size() - system.multipliers();
  for (int i = 0; i < system.multipliers(); ++i)
    if (system.constraint_kind(i) == ConstraintKind::nonholonomic) r[first + i] = 0;
}

}  // namespace bielle::mechanism
