// Static equilibrium as the start of a motion.
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/solvers/start/start_report.hpp"
#include "mechanism/solvers/statics/statics.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::ReadyModel;

namespace {

State settled(const ReadyModel& model, StartReport& report) {
  State state = model.system.start(0);
  settle(model.system, model.environment(), NewtonOptions{}, {}, state, report);
  return state;
}

std::string refusal(const std::string& text) {
  const ReadyModel model(text);
  return bielle::test::message_of<bielle::ComputationError>([&] {
    StartReport report;
    settled(model, report);
  });
}

}  // namespace

TEST_CASE("a cantilever that starts in equilibrium under its weight stays there") {
  const ReadyModel model(R"yaml(
gravity: [0, 0, -9.81]
nodes: {root: {position: [0, 0, 0], fixed: true}, tip: {position: [2, 0, 0]}}
elements:
  bar: {type: beam, nodes: [root, tip], elements: 6, section: {circle: 0.005, young: 70e9, poisson: 0.3, density: 2700}}
)yaml");
  StartReport report;
  const State start = settled(model, report);
  // q L^4/(8 E I), but for its large deflection: 0.2 m of 2 m.
  const double area = M_PI * 25e-6, I = M_PI / 4 * 625e-12;
  const double deflection = 2700 * 9.81 * area * 16 / (8 * 70e9 * I);
  CHECK(report.settled_node == "tip");
  CHECK(report.settled == Approx(deflection).epsilon(0.05));

  TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.9), start);
  integration.start(2e-3);
  double moved = 0, fastest = 0;
  for (int k = 0; k < 500; ++k) {  // a second: three periods of the lowest vibration
    integration.step(2e-3);
    const NodeState& tip = model.node(integration.state(), "tip");
    moved = std::max(moved, (tip.x - model.node(start, "tip").x).norm());
    fastest = std::max(fastest, tip.v.norm());
  }
  // Newton's tolerance is 1e-9 of the forces: 1e-9 of the deflection, per vibration.
  CHECK(moved < 1e-7 * deflection);
  CHECK(fastest < 1e-6 * deflection);
}

TEST_CASE("velocities stay as they are given, in the position of equilibrium") {
  const ReadyModel model(R"yaml(
gravity: [0, 0, -9.81]
nodes: {m: {position: [0, 0, -1], velocity: [0, 0, 0.3], fixed: [x, y, rx, ry, rz]}}
elements:
  m: {type: point_mass, node: m, mass: 2}
  s: {type: spring_damper, nodes: [ground, m], stiffness: 200, length: 1}
)yaml");
  StartReport report;
  const State start = settled(model, report);
  CHECK(model.node(start, "m").x.z() == Approx(-1 - 2 * 9.81 / 200).epsilon(1e-12));
  CHECK((model.node(start, "m").v - Vector3(0, 0, 0.3)).norm() < 1e-15);
}

TEST_CASE("an arm that nothing but joints hold finds the way down to where it hangs") {
  const ReadyModel model(R"yaml(
gravity: [0, 0, -9.81]
nodes: {upper: {position: [0.5, 0, 0]}, lower: {position: [1, 0, 0.5]}}
elements:
  upper: {type: rigid_body, node: upper, mass: 2, inertia: [0.01, 0.2, 0.2]}
  lower: {type: rigid_body, node: lower, mass: 1, inertia: [0.1, 0.1, 0.01]}
joints:
  shoulder: {type: hinge, nodes: [ground, upper], position: [0, 0, 0], axis: [0, 1, 0]}
  elbow: {type: hinge, nodes: [upper, lower], position: [1, 0, 0], axis: [0, 1, 0]}
)yaml");
  StartReport report;
  const State start = settled(model, report);
  CHECK((model.node(start, "upper").x - Vector3(0, 0, -0.5)).norm() < 1e-7);
  CHECK((model.node(start, "lower").x - Vector3(0, 0, -1.5)).norm() < 1e-7);
}

TEST_CASE("what has no equilibrium is said by name") {
  CHECK_THAT(refusal(R"yaml(
gravity: [0, 0, -9.81]
nodes: {stone: {position: [1, 0, 0]}}
elements: {stone: {type: rigid_body, node: stone, mass: 1, inertia: [0.1, 0.1, 0.1]}}
)yaml"),
             Catch::Contains("static equilibrium at the start: none was found"));
}

TEST_CASE("what nothing holds or loads stays as drawn, and is named") {
  const ReadyModel model(R"yaml(
nodes: {wheel: {position: [1, 0, 0]}, box: {position: [2, 0, 0], fixed: [y, z, rx, ry, rz]}}
elements:
  wheel: {type: rigid_body, node: wheel, mass: 1, inertia: [0.1, 0.1, 0.1]}
  box: {type: point_mass, node: box, mass: 1}
  spring: {type: spring_damper, nodes: [ground, box], stiffness: 100, length: 1.9}
joints: {axle: {type: hinge, nodes: [ground, wheel], axis: [0, 0, 1], position: [1, 0, 0]}}
)yaml");
  StartReport report;
  const State start = settled(model, report);
  CHECK((model.node(start, "box").x - Vector3(1.9, 0, 0)).norm() < 1e-9);
  CHECK((model.node(start, "wheel").R - Matrix3::Identity()).norm() < 1e-9);
  CHECK(report.loose == "rotation z of node 'wheel'");
}

TEST_CASE("spins of taut rods are indifferent, whatever rounding makes of their stiffness") {
  // A beam carries a mass by rods between spherical joints: each rod can spin about its axis, which costs nothing.
  std::string nodes =
      "gravity: [0, 0, -9.81]\nnodes:\n  root: {fixed: true}\n  tip: {position: [1, 0, 0]}\n"
      "  mass: {position: [1, 0, -1], fixed: [x, y, rx, ry, rz]}\n";
  std::string elements =
      "elements:\n  beam: {type: beam, nodes: [root, tip], section: {circle: 0.01, young: 210e9, poisson: 0.3, "
      "density: 7850}}\n  mass: {type: point_mass, node: mass, mass: 1}\n";
  std::string joints = "joints:\n";
  for (int k = 0; k < 6; ++k) {
    const double y = 0.05 * k;
    nodes += fmt::format("  rod_{}: {{position: [1, {}, -0.5], axes: {{x: [0, 0, 1], y: [0, 1, 0]}}}}\n", k, y);
    elements +=
        fmt::format("  rod_{0}: {{type: rigid_body, node: rod_{0}, mass: 0.06, inertia: [2e-6, 5e-3, 5e-3]}}\n", k);
    joints += fmt::format(
        "  top_{0}: {{type: spherical, nodes: [tip, rod_{0}], position: [1, {1}, 0]}}\n"
        "  foot_{0}: {{type: spherical, nodes: [mass, rod_{0}], position: [1, {1}, -1]}}\n",
        k, y);
  }
  const ReadyModel rods(nodes + elements + joints);
  StartReport report;
  settled(rods, report);
  CHECK(report.unstable == 0);

  const ReadyModel on_its_tip(
      "gravity: [0, 0, -9.81]\nnodes: {a: {position: [0, 0, 0.5]}}\n"
      "elements: {a: {type: rigid_body, node: a, mass: 10, inertia: [0.5, 0.3, 0.3]}}\n"
      "joints: {b: {type: hinge, nodes: [ground, a], position: [0, 0, 0], axis: [1, 0, 0]}}\n");
  StartReport unstable;
  settled(on_its_tip, unstable);
  CHECK(unstable.unstable == 1);
}

TEST_CASE("a pendulum hangs down in equilibrium, also where its node stands at the origin") {
  // The node is the hinge, d away from the origin; the centre of mass is 0.3 m from it, drawn level.
  for (const double d : {0.0, 1e-12, 1e-5, 1e-3, 0.9}) {
    CAPTURE(d);
    const ReadyModel model(fmt::format(
        "gravity: [0, 0, -9.81]\nnodes: {{a: {{position: [{0}, 0, 0]}}}}\n"
        "elements: {{a: {{type: rigid_body, node: a, mass: 10, inertia: [0.1, 1, 1], centre: [0.3, 0, 0]}}}}\n"
        "joints: {{b: {{type: hinge, nodes: [ground, a], position: [{0}, 0, 0], axis: [0, 1, 0]}}}}\n",
        d));
    StartReport report;
    const State state = settled(model, report);
    CHECK(state.nodes[1].R(2, 0) == Approx(-1).margin(1e-9));  // its x axis points down
    CHECK(report.unstable == 0);
  }
}
