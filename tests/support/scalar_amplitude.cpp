#include "tests/support/scalar_amplitude.hpp"

#include <cmath>

namespace bielle::test {

using namespace mechanism;

void ScalarAmplitude::declare(Declaration& declaration) const {
  declaration.amplitudes = {unknown_};
  declaration.stiffness = declaration.damping = declaration.mass = true;
}

void ScalarAmplitude::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const auto& [m, d, k, b, w] = law_;
  const double q = state.amplitude()[0], x = q / b;
  r[0] += m * state.amplitude_acceleration()[0] + d * state.amplitude_rate()[0] + k * q * (1 + x * x) -
          k * b * (1 + std::sin(w * state.time()));
}

void ScalarAmplitude::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const double x = state.amplitude()[0] / law_.b;
  if (tangent.wants_K) tangent.K.dense()(0, 0) += law_.k * (1 + 3 * x * x);
  if (tangent.wants_C) tangent.C.dense()(0, 0) += law_.d;
  if (tangent.wants_M) tangent.M.dense()(0, 0) += law_.m;
}

}  // namespace bielle::test
