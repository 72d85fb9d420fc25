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
