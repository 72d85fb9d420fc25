#include "tests/support/coordinate_gear.hpp"

namespace bielle::test {

using namespace mechanism;

void CoordinateGear::declare(Declaration& declaration) const {
  declaration.references = {joints_[0], joints_[1]};
  declaration.multipliers = {{"gear", "N m"}};
}

void CoordinateGear::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  CoordinateDerivatives jet;
  for (const int k : {0, 1}) {
    const auto j = static_cast<std::size_t>(k);
    joints_[j]->calc_coordinate(0, state.of(k), jet);
    r[0] += factors_[j] * jet.value;
    r.segment(state.slots().reference_row(k), jet.g().size()) += state.multiplier()[0] * factors_[j] * jet.g();
  }
}

void CoordinateGear::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (!tangent.wants_K) return;
  auto K = tangent.K.dense();
  CoordinateDerivatives jet;
  for (const int k : {0, 1}) {
    const auto j = static_cast<std::size_t>(k);
    joints_[j]->calc_coordinate(0, state.of(k), jet);
    const int at = state.slots().reference_row(k);
    const auto n = jet.g().size();
    K.block(0, at, 1, n) += factors_[j] * jet.g().transpose();
    K.block(at, 0, n, 1) += factors_[j] * jet.g();
    K.block(at, at, n, n) += state.multiplier()[0] * factors_[j] * jet.S();
  }
}

void CoordinateGear::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                          Eigen::Ref<VectorX> acceleration) const {
  CoordinateDerivatives jet;
  for (const int k : {0, 1}) {
    const auto j = static_cast<std::size_t>(k);
    const LocalState of_joint = state.of(k);
    joints_[j]->calc_coordinate(0, of_joint, jet);
    VectorX v(jet.g().size()), a(jet.g().size());
    get_local_velocities(of_joint, v);
    get_local_accelerations(of_joint, a);
    velocity[0] += factors_[j] * jet.g().dot(v);
    acceleration[0] += factors_[j] * (jet.g().dot(a) + v.dot(jet.S() * v));
  }
}

}  // namespace bielle::test
