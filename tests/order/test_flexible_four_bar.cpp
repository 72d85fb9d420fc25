// The order of the scheme on a four-bar with a flexible coupler that falls under its weight. No reference is needed:
// the solutions at h, h/2, ... converge to each other (self_convergence.hpp). The coupler is so soft (a band of rubber,
// 6 Hz in bending) that the steps resolve its highest modes, also axial and in shear: only then is the order
// observable.
#include <fmt/format.h>

#include "tests/order/self_convergence.hpp"
#include "tests/support/four_bar.hpp"

using namespace bielle::mechanism;
using bielle::test::check_order_two;
using bielle::test::ReadyModel;

namespace {

std::string flexible_four_bar() {
  const auto [A, B, C, D] = bielle::test::released_four_bar();
  const auto at = [](const Vector3& x) { return fmt::format("[{}, {}, {}]", x.x(), x.y(), x.z()); };
  return "gravity: [0, -9.81, 0]\nnodes:\n  crank: {position: " + at(0.5 * (A + B)) + "}\n  b: {position: " + at(B) +
         "}\n  c: {position: " + at(C) + "}\n  rocker: {position: " + at(0.5 * (C + D)) + R"yaml(}
elements:
  crank: {type: rigid_body, node: crank, mass: 0.3, inertia: [0.01, 0.01, 0.01]}
  rocker: {type: rigid_body, node: rocker, mass: 0.7, inertia: [0.03, 0.03, 0.03]}
  coupler:
    type: beam
    nodes: [b, c]
    elements: 3
    section: {EA: 400, GAy: 300, GAz: 300, GJ: 4, EIy: 4, EIz: 4, mass_per_length: 1, Jx: 0.02, Jy: 0.02, Jz: 0.02}
joints:
  a: {type: hinge, nodes: [ground, crank], axis: [0, 0, 1], position: [0, 0, 0]}
  b: {type: hinge, nodes: [crank, b], axis: [0, 0, 1]}
  c: {type: hinge, nodes: [rocker, c], axis: [0, 0, 1]}
  d: {type: hinge, nodes: [ground, rocker], axis: [0, 0, 1], position: [1, 0, 0]}
)yaml";
}

}  // namespace

TEST_CASE("a four-bar with a flexible coupler is of order 2 in positions, velocities and multipliers") {
  const ReadyModel model(flexible_four_bar());
  for (const ConstraintForm form : {ConstraintForm::position, ConstraintForm::stabilised})
    for (const double factor : {0.5, 2.0})
      check_order_two(model, Scheme::generalized_alpha(0.8), form, 2e-3, 0.08, factor, 0.15);
}
