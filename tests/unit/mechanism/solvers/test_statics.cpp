#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/statics.hpp"

using namespace bielle::mechanism;

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

/// A beam under an end moment that bends it by `turns`, in three elements and two load steps.
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
  CHECK_THROWS_WITH(rolled_up(1.49),
                    Catch::Contains("beam 'strip', element") && Catch::Contains("give the beam more `elements`"));
}

TEST_CASE("prescribed joint motions grow with the load factor as loads do") {
  // The crank goes to its angle in equal parts, from where it stands; more than half a turn cannot be taken at once.
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

TEST_CASE("a second static analysis starts from where the first one took a drive") {
  const MechanismFile file = read_mechanism_text(R"yaml(
nodes: {arm: {position: [1, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {axle: {type: hinge, nodes: [ground, arm], axis: [0, 0, 1], position: [0, 0, 0]}}
drives: {motor: {joint: axle, angle: "1 + t"}}
)yaml",
                                                 "crank.yaml");
  System system(file.model);
  State state = system.start(0);
  solve_statics(system, file.model.environment, 2, NewtonOptions{}, state);
  state.time = 0.5;
  std::vector<double> angles;
  solve_statics(system, file.model.environment, 2, NewtonOptions{}, state,
                [&](const State& s, double, int) { angles.push_back(std::atan2(s.nodes[1].x.y(), s.nodes[1].x.x())); });
  REQUIRE(angles.size() == 2);
  CHECK(angles[0] == Approx(1.25).epsilon(1e-10));
  CHECK(angles[1] == Approx(1.5).epsilon(1e-10));
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
