// The heavy top of O. Bruls, A. Cardona, M. Arnold, Mech. Mach. Theory 48 (2012) 121 over two seconds, described two
// ways: node at the centre of mass and joint at the tip, or node at the tip, which is held. m = 15 kg, J =
// diag(0.234375, 0.46875, 0.234375) kg m^2 about the centre at (0, 1, 0), Omega(0) = (0, 150, -4.61538) rad/s.
// Reference: Euler-Poinsot equations in quaternions (tests/references/heavy_top.py). Orders of convergence:
// tests/order.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/reference_table.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/second_order.hpp"

using namespace bielle::mechanism;
using bielle::test::check_second_order;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

const std::string centre = R"yaml(
gravity: [0, 0, -9.81]
nodes: {top: {position: [0, 1, 0], velocity: [4.61538, 0, 0], angular_velocity: [0, 150, -4.61538]}}
elements: {top: {type: rigid_body, node: top, mass: 15, inertia: [0.234375, 0.46875, 0.234375]}}
joints: {pivot: {type: spherical, nodes: [ground, top], position: [0, 0, 0]}}
)yaml";

// The tip is held as a node, so that there is no constraint and no multiplier. The inertia about the node is 0.234375 +
// 15 = 15.234375.
const std::string tip = R"yaml(
gravity: [0, 0, -9.81]
nodes: {tip: {fixed: [x, y, z], angular_velocity: [0, 150, -4.61538]}}
elements:
  top: {type: rigid_body, node: tip, mass: 15, centre: [0, 1, 0], inertia: [15.234375, 0.46875, 15.234375], inertia_about: node}
)yaml";

}  // namespace

TEST_CASE("the heavy top follows the Euler-Poinsot equations for two seconds, however it is described") {
  const bielle::test::ReferenceTable exact("heavy_top");
  const double times[] = {0.1, 0.5, 1, 1.5, 2};
  for (const std::string& text : {centre, tip}) {
    const ReadyModel model(text);
    const bool from_tip = text == tip;
    const auto errors = [&](double h) -> VectorX {
      VectorX e = VectorX::Zero(6 * 5);
      int k = 0;
      integrate(model, Scheme::generalized_alpha(0.9), h, 2, [&](const State& state) {
        if (k == 5 || std::abs(state.time - times[k]) > h / 2) return;
        const NodeState& node = model.node(state, from_tip ? "tip" : "top");
        const Vector3 x = from_tip ? Vector3(node.x + node.R * Vector3(0, 1, 0)) : node.x;
        const std::string row = fmt::format("{}.", times[k]);
        e.segment<6>(6 * k) << x - exact.vector(row + "centre"), (node.Omega - exact.vector(row + "Omega")) / 5;
        ++k;
      });
      CHECK(k == 5);
      return e;
    };
    check_second_order(errors, 1e-3, 2, 0.1, 0.1);
  }
}

TEST_CASE("the heavy top precesses steadily at the two speeds that its equations say") {
  // Axis at theta = 60 degrees from the vertical, 150 rad/s about it: with A = 15.234375 and C = 0.46875 kg m^2
  // A P^2 cos(theta) - C 150 P + m g l = 0.
  for (const double P : {3.206973701704, 6.023795529065}) {
    const ReadyModel model(fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes: {{tip: {{fixed: [x, y, z], rotation_vector: [pi/6, 0, 0], angular_velocity: [0, 150, "{:.13f}*sin(pi/3)"]}}}}
elements:
  top: {{type: rigid_body, node: tip, mass: 15, centre: [0, 1, 0], inertia: [0.234375, 0.46875, 0.234375]}}
)yaml",
                                       P));
    const auto errors = [&](double h) -> VectorX {
      const NodeState node = model.node(integrate(model, Scheme::generalized_alpha(0.9), h, 1), "tip");
      return node.R.col(1) - Vector3(-std::sin(M_PI / 3) * std::sin(P), std::sin(M_PI / 3) * std::cos(P), 0.5);
    };
    check_second_order(errors, 5e-4, 2, 0.1, 0.1);
  }
}
