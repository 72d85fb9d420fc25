#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/dynamics/march.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/start/start_report.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::ReadyModel;

namespace test_redundancy {
namespace {

/// A parallelogram of three links and four hinges: 3 * 6 - 4 * 5 = -2 by counting, one degree of freedom in fact.
const char* const four_bar = R"yaml(
gravity: [0, -9.81, 0]
nodes:
  crank: {position: [0, 0.5, 0]}
  coupler: {position: [0.5, 1, 0]}
  rocker: {position: [1, 0.5, 0]}
elements:
  crank: {type: rigid_body, node: crank, mass: 1, inertia: [0.0833, 0.001, 0.0833]}
  coupler: {type: rigid_body, node: coupler, mass: 1, inertia: [0.001, 0.0833, 0.0833]}
  rocker: {type: rigid_body, node: rocker, mass: 1, inertia: [0.0833, 0.001, 0.0833]}
joints:
  a: {type: hinge, nodes: [ground, crank], axis: [0, 0, 1], position: [0, 0, 0]}
  b: {type: hinge, nodes: [crank, coupler], axis: [0, 0, 1], position: [0, 1, 0]}
  c: {type: hinge, nodes: [coupler, rocker], axis: [0, 0, 1], position: [1, 1, 0]}
  d: {type: hinge, nodes: [ground, rocker], axis: [0, 0, 1], position: [1, 0, 0]}
)yaml";

}  // namespace

TEST_CASE("a planar four-bar of hinges in space has three redundant constraints, named in the last joint") {
  const MechanismFile file = read_mechanism_text(four_bar, "four_bar.yaml");
  System system(file.model);
  const std::vector<int> redundant = find_redundant(system, file.model.environment, system.start(0));
  // 18 displacements - 20 constraints + 3 redundant ones = 1 degree of freedom.
  REQUIRE(redundant.size() == 3);
  for (const int multiplier : redundant)
    CHECK_THAT(system.equation_name(system.dofs() + multiplier), Catch::Contains("joint 'd'"));
}

TEST_CASE("with the redundant constraints set aside the four-bar moves on its circle and all joints stay closed") {
  MechanismFile file = read_mechanism_text(four_bar, "four_bar.yaml");
  file.model.node(*file.model.find_node("coupler")).velocity = Vector3(1, 0, 0);
  file.model.node(*file.model.find_node("crank")).angular_velocity = Vector3(0, 0, -1);
  System system(file.model);
  State start = system.start(0);
  const std::vector<int> redundant = find_redundant(system, file.model.environment, start);
  system.set_aside(redundant);
  TimeIntegration integration(system, file.model.environment, Scheme::generalized_alpha(0.9), start);
  const double h = 2e-3;
  integration.start(h);
  for (int k = 0; k < 200; ++k) integration.step(h);
  const NodeState& coupler = integration.state().nodes[static_cast<std::size_t>(*file.model.find_node("coupler"))];
  // The coupler's centre runs on a circle of radius 1 about (0.5, 0) and does not turn.
  CHECK(std::abs((coupler.x - Vector3(0.5, 0, 0)).norm() - 1) < 1e-12);
  CHECK(log_so3(coupler.R).norm() < 1e-12);
  // Removed constraints are satisfied nevertheless.
  system.set_aside({});
  VectorX r(system.size());
  system.residual(integration.state(), file.model.environment, r);
  CHECK(r.tail(system.multipliers()).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("a drive on what joints hold already is named when it wants to move it") {
  const std::string text = std::string(four_bar) + R"yaml(
drives: {motor: {joint: a, angle: "t"}, second: {joint: d, angle: "0.5*t"}}
)yaml";
  const MechanismFile file = read_mechanism_text(text, "four_bar.yaml");
  System system(file.model);
  State start = system.start(0);
  system.set_aside(find_redundant(system, file.model.environment, start));
  REQUIRE(system.set_aside().size() == 4);
  TimeIntegration integration(system, file.model.environment, Scheme::generalized_alpha(0.8), start);
  CHECK_THROWS_WITH(integration.step(0.01), Catch::Contains("drive 'second'") && Catch::Contains("contradicts"));
}

TEST_CASE("redundant joints of a model that stands at the origin are held by the others") {
  // All nodes are at the origin, so that no node gives a length; rounding of turned axes remains.
  const MechanismFile file = read_mechanism_text(R"yaml(
nodes: {rotor: {rotation_vector: [0.3, 0.2, 0.1], angular_velocity: [1, 2, 3]}}
elements: {rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [0.1, 0.12, 0.15]}}
joints:
  left: {type: spherical, nodes: [ground, rotor], position: [0.1, 0.2, 0.3]}
  right: {type: spherical, nodes: [ground, rotor], position: [-0.2, -0.4, -0.6]}
)yaml",
                                                 "origin.yaml");
  System system(file.model);
  const State start = system.start(0);
  system.set_aside(find_redundant(system, file.model.environment, start));
  REQUIRE(system.set_aside().size() == 1);
  TimeIntegration integration(system, file.model.environment, Scheme::generalized_alpha(0.8), start);
  for (int k = 0; k < 20; ++k) CHECK_NOTHROW(integration.step(0.01));
}

TEST_CASE("a model in which everything is held has nothing to solve and says nothing false") {
  const MechanismFile file = read_mechanism_text(R"yaml(
gravity: [0, 0, -9.81]
nodes: {a: {position: [1, 0, 0], fixed: true}}
elements: {a: {type: rigid_body, node: a, mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints: {weld: {type: rigid, nodes: [ground, a]}}
)yaml",
                                                 "held.yaml");
  System system(file.model);
  const State start = system.start(0);
  system.set_aside(find_redundant(system, file.model.environment, start));
  CHECK(system.set_aside().size() == 6);
  TimeIntegration integration(system, file.model.environment, Scheme::generalized_alpha(0.8), start);
  integration.start(0.01);
  CHECK_NOTHROW(integration.step(0.01));
}

TEST_CASE("a step that fails near a dead centre names the constraints that repeat others there") {
  // A slider-crank whose slider is pulled beyond its reach.
  const ReadyModel model(R"yaml(
nodes:
  crank: {position: [0.25, 0.2, 0]}
  rod: {position: [0.75, 0.2, 0]}
  slider: {position: [1.0, 0, 0]}
elements:
  crank: {type: rigid_body, node: crank, mass: 1, inertia: [0.01, 0.02, 0.02]}
  rod: {type: rigid_body, node: rod, mass: 1, inertia: [0.01, 0.02, 0.02]}
  slider: {type: rigid_body, node: slider, mass: 1, inertia: [0.01, 0.02, 0.02]}
joints:
  main: {type: hinge, nodes: [ground, crank], position: [0, 0, 0], axis: [0, 0, 1]}
  pin: {type: hinge, nodes: [crank, rod], position: [0.5, 0.4, 0], axis: [0, 0, 1]}
  wrist: {type: hinge, nodes: [rod, slider], position: [1, 0, 0], axis: [0, 0, 1]}
  guide: {type: prismatic, nodes: [ground, slider], position: [1, 0, 0], axis: [1, 0, 0]}
drives: {push: {joint: guide, displacement: "t"}}
)yaml");
  TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8), model.system.start(0));
  StepOptions options;
  options.size = 5e-3;
  March march(integration, 0, 1, options);
  const std::string message = bielle::test::message_of<bielle::ComputationError>([&] {
    while (!march.done()) march.advance();
  });
  CHECK_THAT(message, Catch::Contains("singular position") && Catch::Contains("drive 'push'"));
  CHECK(integration.state().time == Approx(2 * std::hypot(0.5, 0.4) - 1).margin(5e-3));
}

TEST_CASE("a joint that is assembled the wrong way round is turned, or refused, although its constraints hold") {
  const auto assembled = [](const std::string& fixed) {
    const ReadyModel model("nodes: {m: {position: [1, 0, 0], fixed: " + fixed + R"yaml(}}
elements: {m: {type: rigid_body, node: m, mass: 1, inertia: [1, 1, 1]}}
joints: {main: {type: hinge, nodes: [ground, m], position: [0, 0, 0], axis: [0, 0, 1]}}
)yaml");
    State state = model.system.start(0);
    state.nodes.back().R = exp_so3(Vector3(3.14159265358979324, 0, 0));
    StartReport report;
    assemble_positions(model.system, model.environment(), state, report);
    return state;
  };
  const State turned = assembled("[]");
  CHECK((turned.nodes.back().R.col(2) - Vector3::UnitZ()).norm() < 1e-12);
  CHECK((turned.nodes.back().x - turned.nodes.back().R.col(0)).norm() < 1e-12);
  // A node that is held in some directions is not turned.
  CHECK_THROWS_WITH(assembled("[z]"), Catch::Contains("joint 'main': its axes point in opposite directions"));
}

}  // namespace test_redundancy
