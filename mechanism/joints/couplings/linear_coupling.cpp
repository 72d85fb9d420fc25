#include "mechanism/joints/couplings/linear_coupling.hpp"

#include <algorithm>

namespace bielle::mechanism {

void LinearCoupling::declare(Declaration& declaration) const {
  references().declare(declaration);
  declaration.stiffness = true;
  declaration.multipliers.push_back({"ratio", unit().force_units()});
}

void LinearCoupling::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  thread_local CoordinateSlopes slopes;
  const double lambda = state.multiplier()[0];
  long double sum = 0;  // long double, because angles of many turns cancel in the sum
  for (const Term& term : terms()) {
    term.joint->calc_slopes(term.coordinate, state.of(term.reference), slopes);
    r.segment(state.slots().reference_row(term.reference), slopes.g().size()) += (lambda * term.factor) * slopes.g();
    sum += static_cast<long double>(term.factor) * slopes.value;
  }
  r[0] += static_cast<double>(sum);
}

void LinearCoupling::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  thread_local CoordinateDerivatives jet;
  const double lambda = state.multiplier()[0];
  auto K = tangent.K.dense();
  for (const Term& term : terms()) {
    term.joint->calc_coordinate(term.coordinate, state.of(term.reference), jet);
    const int at = state.slots().reference_row(term.reference);
    const auto n = jet.g().size();
    K.block(at, at, n, n) += (lambda * term.factor) * jet.S();
    K.block(at, 0, n, 1) += term.factor * jet.g();
    K.block(0, at, 1, n) += term.factor * jet.g().transpose();
  }
}

void LinearCoupling::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                          Eigen::Ref<VectorX> acceleration) const {
  thread_local CoordinateDerivatives jet;
  for (const Term& term : terms()) {
    const LocalState of_joint = state.of(term.reference);
    term.joint->calc_coordinate(term.coordinate, of_joint, jet);
    const auto [first, second] = Joint::calc_coordinate_rates(of_joint, jet);
    velocity[0] += term.factor * first;
    acceleration[0] += term.factor * second;
  }
}

double LinearCoupling::turning_rate(const LocalState& state) const {
  double rate = 0;
  for (const Term& term : terms()) rate = std::max(rate, term.joint->turning_rate(state.of(term.reference)));
  return rate;
}

}  // namespace bielle::mechanism
