#include <algorithm>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "mechanism/solvers/statics/statics.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::ComputationError;
using bielle::test::message_of;
using bielle::test::ReadyModel;
using Catch::Contains;
using Catch::Matchers::WithinAbs;

TEST_CASE("a hinged arm on a spring finds the angle of its equilibrium") {
  // Moments about the hinge: m g L cos(q) = T(q); the spring from (L, 0, h) pulls the tip: solved here by bisection.
  const MechanismFile file = read_mechanism_text(R"yaml(
gravity: [0, 0, -9.81]
nodes: {arm: {position: [1, 0, 0]}, top: {position: [1, 0, 1], fixed: true}}
elements:
  arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.1, 0.1, 0.1]}
  spring: {type: spring_damper, nodes: [top, arm], stiffness: 100, length: 1}
joints: {axle: {type: hinge, nodes: [ground, arm], axis: [0, 1, 0], position: [0, 0, 0]}}
)yaml",
                                                 "arm.yaml");
  System system(file.model);
  State state = system.start(0);
  solve_statics(system, file.model.environment, 4, NewtonOptions{}, state);
  const auto moment = [](double q) {  // q: downward angle of the arm
    const double x = std::cos(q), z = -std::sin(q);
    const double dx = 1 - x, dz = 1 - z, length = std::hypot(dx, dz), pull = 100 * (length - 1);
    return 2 * 9.81 * std::cos(q) - pull * (dz / length * x - dx / length * z);
  };
  double low = 0, high = 1;
  for (int k = 0; k < 60; ++k) (moment(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  CHECK(std::atan2(-state.nodes[1].x.z(), state.nodes[1].x.x()) == Approx(low).epsilon(1e-9));
}

namespace {

/// Returns the state of a beam under an end moment that bends it by `turns`, in three elements and two load steps.
State rolled_up(double turns) {
  const MechanismFile file = read_mechanism_text(
      R"yaml(
nodes: {root: {position: [0, 0, 0], fixed: true}, tip: {position: [3, 0, 0]}}
elements:
  strip: {type: beam, nodes: [root, tip], elements: 3, section: {EA: 1e4, GAy: 3e3, GAz: 3e3, GJ: 20, EIy: 20, EIz: 2}}
loads: {roll: {node: tip, moment: [0, 0, "4*pi/3*turns"]}}
parameters: {turns: )yaml" +
          std::to_string(turns) + "}\n",
      "strip.yaml");
  System system(file.model);
  State state = system.start(0);
  solve_statics(system, file.model.environment, 2, NewtonOptions{}, state);
  return state;
}

}  // namespace

TEST_CASE("load steps in which a beam's iterates turn too far are made smaller") {
  // A full circle: the tip is back at the root. Newton's method from the straight beam leaps over half a turn per
  // element.
  CHECK(rolled_up(1).nodes[2].x.norm() < 1e-8);
}

TEST_CASE("what a component refuses at every load step is the error of the analysis") {
  CHECK_THROWS_WITH(rolled_up(1.49), Contains("load factor 1 is refused") && Contains("beam 'strip', element") &&
                                         Contains("give the beam more `elements`") && Contains("largest residual: "));
}

TEST_CASE("prescribed joint motions grow with the load factor as loads do") {
  // The crank moves to its angle in equal parts, from its present one; more than half a turn cannot be made at once.
  const MechanismFile file = read_mechanism_text(R"yaml(
nodes: {arm: {position: [1, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {axle: {type: hinge, nodes: [ground, arm], axis: [0, 0, 1], position: [0, 0, 0]}}
drives: {motor: {joint: axle, angle: "4"}}
)yaml",
                                                 "crank.yaml");
  System system(file.model);
  State state = system.start(0);
  std::vector<double> angles;
  solve_statics(system, file.model.environment, 8, NewtonOptions{}, state,
                [&](const State& s, double, int) { angles.push_back(std::atan2(s.nodes[1].x.y(), s.nodes[1].x.x())); });
  REQUIRE(angles.size() == 8);
  for (std::size_t k = 0; k < 8; ++k)
    CHECK(std::remainder(angles[k] - 0.5 * static_cast<double>(k + 1), 2 * M_PI) == Approx(0).margin(1e-10));
}

TEST_CASE("a static analysis takes loads, drives and node motions on from where they have come, alike") {
  // A spring between a driven slider, a moved node and a load: the ball between them stands where forces balance.
  const ReadyModel model(R"yaml(
nodes:
  slider: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}
  ball: {position: [2, 0, 0], fixed: [y, z, rx, ry, rz]}
  wall: {position: [3, 0, 0], motion: {x: "0.3 + t", y: 0, z: 0, rx: 0, ry: 0, rz: 0}}
elements:
  a: {type: spring_damper, nodes: [slider, ball], stiffness: 10, damping: 5}
  b: {type: spring_damper, nodes: [ball, wall], stiffness: 30, damping: 7}
joints: {guide: {type: prismatic, nodes: [ground, slider], axis: [1, 0, 0]}}
drives: {motor: {joint: guide, displacement: "0.2 + t"}}
loads: {f: {node: ball, force: [4, 0, 0]}}
)yaml");
  State state = model.system.start(0);
  const auto check = [&](const State& s, double factor, double motions) {
    CAPTURE(factor, motions);
    CHECK_THAT(model.node(s, "slider").x.x(), WithinAbs(1 + 0.2 * motions, 1e-12));
    CHECK_THAT(model.node(s, "wall").x.x(), WithinAbs(3 + 0.3 * motions, 1e-15));
    CHECK_THAT(model.node(s, "ball").x.x(),
               WithinAbs(2 + (10 * 0.2 * motions + 30 * 0.3 * motions + 4 * factor) / 40, 1e-12));
  };
  const auto solve = [&](const Loaded& start, double motions_at_half) {
    int steps = 0;
    solve_statics(model.system, model.environment(), LoadSteps(2, start), NewtonOptions{}, state,
                  [&](const State& s, double factor, int) {
                    ++steps;
                    CHECK(factor == (steps == 1 ? start.factor + (1 - start.factor) / 2 : 1));
                    check(s, factor, steps == 1 ? motions_at_half : 1);
                  });
    CHECK(steps == 2);
  };
  solve({}, 0.5);
  // After an assembly the motions are complete; from half of everything; from beyond the full load.
  solve({0, 1}, 1);
  solve({0.5, 0.5}, 0.75);
  solve({3, 3}, 2);
}

TEST_CASE("after a motion a static analysis goes down to equilibrium in one step, from afar as well") {
  // A hinged arm that stands upright is to hang: at first only inertia resists.
  const ReadyModel model(R"yaml(
gravity: [0, 0, -9.81]
nodes: {arm: {position: [0.01, 0, 1]}}
elements: {arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {axle: {type: hinge, nodes: [ground, arm], axis: [0, 1, 0], position: [0, 0, 0]}}
)yaml");
  State state = model.system.start(0);
  int steps = 0;
  solve_statics(model.system, model.environment(), LoadSteps(10, {1, 1}), NewtonOptions{}, state,
                [&](const State&, double factor, int) {
                  ++steps;
                  CHECK(factor == 1);
                });
  CHECK(steps == 1);
  CHECK(std::abs(model.node(state, "arm").x.x()) < 1e-8);
}

TEST_CASE("a joint counts the turns of a drive that statics take there from the drawn position") {
  const ReadyModel model(R"yaml(
nodes: {arm: {position: [1, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {axle: {type: hinge, nodes: [ground, arm], axis: [0, 0, 1], position: [0, 0, 0]}}
drives: {motor: {joint: axle, angle: "15"}}
)yaml");
  State state = model.system.start(0);
  const auto axle = std::find_if(model.file.model.members().begin(), model.file.model.members().end(),
                                 [](const Member& member) { return member.component->name() == "axle"; });
  const Slots& slots = model.system.slots()[static_cast<std::size_t>(axle - model.file.model.members().begin())];
  solve_statics(model.system, model.environment(), 8, NewtonOptions{}, state, [&](const State& s, double factor, int) {
    // The step is accepted before it is recorded.
    CHECK_THAT(s.memory[slots.memory_begin], WithinAbs(15 * factor, 1e-10));
  });
}

TEST_CASE("in statics a joint with a given rate stays where it is") {
  const MechanismFile file = read_mechanism_text(R"yaml(
gravity: [0, -9.81, 0]
nodes: {arm: {position: [1, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {axle: {type: hinge, nodes: [ground, arm], axis: [0, 0, 1], position: [0, 0, 0]}}
drives: {motor: {joint: axle, rate: "3"}}
)yaml",
                                                 "crank.yaml");
  System system(file.model);
  State state = system.start(0);
  solve_statics(system, file.model.environment, 2, NewtonOptions{}, state);
  CHECK((state.nodes[1].x - Vector3(1, 0, 0)).norm() < 1e-12);
  // The motor holds the weight at its arm: residual m g L + lambda = 0 about z.
  CHECK(state.multiplier[system.multipliers() - 1] == Approx(-2 * 9.81).epsilon(1e-9));
}
