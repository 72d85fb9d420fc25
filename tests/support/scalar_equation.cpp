#include "tests/support/scalar_equation.hpp"

namespace bielle::test {

using namespace mechanism;

ScalarEquation::ScalarEquation(std::string name, Declaration::Scalar unknown, std::function<Law(double, double)> law)
    : Component("scalar_equation", std::move(name)), unknown_(std::move(unknown)), law_(std::move(law)) {}

void ScalarEquation::declare(Declaration& declaration) const {
  declaration.first_order = {unknown_};
  declaration.stiffness = declaration.damping = true;
}

void ScalarEquation::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  r[0] += law_(state.first_order()[0], state.first_order_rate()[0]).f;
}

void ScalarEquation::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  const Law law = law_(state.first_order()[0], state.first_order_rate()[0]);
  if (tangent.wants_K) tangent.K.dense()(0, 0) += law.by_value;
  if (tangent.wants_C) tangent.C.dense()(0, 0) += law.by_rate;
}

}  // namespace bielle::test
