#include "tests/support/state_mixer.hpp"

#include <cmath>

namespace bielle::test {

using namespace mechanism;

namespace {

/// p with its derivatives over the local layout, and w.
struct Mix {
  double p = 0;
  VectorX by_position, by_rate, by_acceleration, w;
  explicit Mix(const LocalState& state) {
    const int n = state.slots().size();
    for (VectorX* vector : {&by_position, &by_rate, &by_acceleration, &w}) vector->setZero(n);
    add(state, 0);
  }

 private:
  /// Returns a number in [0.2, 1] of its own for each row.
  static double share(int row, double phase) { return 0.6 + 0.4 * std::sin(2.3 * row + phase); }
  static Vector3 shares(int row, double phase) {
    return {share(row, phase), share(row + 1, phase), share(row + 2, phase)};
  }

  void add(const LocalState& state, int begin) {
    const Slots& slots = state.slots();
    for (int k = 0; k < static_cast<int>(slots.nodes.size()); ++k) {
      const NodeState& node = state.node(k);
      const int row = begin + 6 * k;
      const Vector3 b = shares(row, 1), c = shares(row, 2);
      add_linear(node.x, node.v, node.a, row);
      add_linear(Vector3::Zero(), node.Omega, node.Omegadot, row + 3);
      p += b.dot(node.R * c);
      by_position.segment<3>(row + 3) = c.cross(node.R.transpose() * b);  // b . R (dTheta x c)
      w.segment<6>(row) << shares(row, 3), shares(row, 4);
    }
    const auto scalars = [&](const auto& value, const VectorX& rate, const VectorX& acceleration, int row) {
      add_linear(value, rate, acceleration, begin + row);
      for (int k = 0; k < value.size(); ++k) w[begin + row + k] = share(begin + row + k, 3);
    };
    scalars(state.amplitude(), state.amplitude_rate(), state.amplitude_acceleration(), slots.amplitude_row());
    const VectorX none = VectorX::Zero(slots.first_orders);
    scalars(state.first_order(), state.first_order_rate(), none, slots.first_order_row());
    by_acceleration.segment(begin + slots.first_order_row(), slots.first_orders).setZero();
    if (begin > 0)
      for (int k = 0; k < slots.multipliers; ++k) {
        const int row = begin + slots.multiplier_row() + k;
        p += share(row, 1) * state.multiplier()[k];
        by_position[row] = share(row, 1);
      }
    for (std::size_t k = 0; k < slots.references.size(); ++k)
      add(state.of(static_cast<int>(k)), begin + slots.reference_rows[k]);
  }
  template <class Value, class Rate, class Acceleration>
  void add_linear(const Value& value, const Rate& rate, const Acceleration& acceleration, int row) {
    for (int k = 0; k < value.size(); ++k) {
      by_position[row + k] = share(row + k, 1);
      by_rate[row + k] = 0.3 * share(row + k, 5);
      by_acceleration[row + k] = 0.1 * share(row + k, 6);
      p += by_position[row + k] * value[k] + by_rate[row + k] * rate[k] + by_acceleration[row + k] * acceleration[k];
    }
  }
};

}  // namespace

void StateMixer::declare(Declaration& declaration) const {
  declaration.nodes = nodes_;
  declaration.references = references_;
  declaration.stiffness = declaration.damping = declaration.mass = true;
}

void StateMixer::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const Mix mix(state);
  r += (std::sin(mix.p) + mix.p * mix.p / 4) * mix.w;
}

void StateMixer::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const Mix mix(state);
  const VectorX by_p = (std::cos(mix.p) + mix.p / 2) * mix.w;
  if (tangent.wants_K) tangent.K.dense() += by_p * mix.by_position.transpose();
  if (tangent.wants_C) tangent.C.dense() += by_p * mix.by_rate.transpose();
  if (tangent.wants_M) tangent.M.dense() += by_p * mix.by_acceleration.transpose();
}

}  // namespace bielle::test
