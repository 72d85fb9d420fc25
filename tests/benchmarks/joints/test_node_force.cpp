// Forces between nodes: they conserve momentum and angular momentum, and act like the equivalent springs.
#include <catch2/catch.hpp>

#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/second_order.hpp"

using bielle::mechanism::NodeState;
using bielle::mechanism::Session;
using bielle::test::move;
using bielle::test::move_to;
using Eigen::Vector3d;

namespace {

const std::string bodies = R"yaml(
nodes:
  a: {position: [0, 0, 0], velocity: [0.3, 0, 0.1], angular_velocity: [0.2, -1, 0.4]}
  b: {position: [1, 0.2, 0], velocity: [-0.1, 0.4, 0], angular_velocity: [1, 0.3, 0.5]}
elements:
  one: {type: rigid_body, node: a, mass: 2, inertia: [0.1, 0.2, 0.25]}
  two: {type: rigid_body, node: b, mass: 1, inertia: [0.1, 0.12, 0.2]}
)yaml";

Vector3d momentum(const Session& session) { return 2 * session.node("a").v + session.node("b").v; }

Vector3d angular_momentum(const Session& session) {
  const NodeState &a = session.node("a"), &b = session.node("b");
  return a.x.cross(2 * a.v) + b.x.cross(b.v) + a.R * Vector3d(0.1, 0.2, 0.25).cwiseProduct(a.Omega) +
         b.R * Vector3d(0.1, 0.12, 0.2).cwiseProduct(b.Omega);
}

}  // namespace

TEST_CASE("a force between nodes keeps momentum and angular momentum, along whatever axes") {
  for (const char* axes : {"first", "second", "inertial"}) {
    const std::string text =
        bodies + "  push: {type: node_force, nodes: [a, b], at: [0.1, 0.2, -0.1], axes: " + axes +
        ", force: [1, \"2*sin(5*t)\", \"-b.velocity.x\"], moment: [0.1, 0, \"0.2*distance(a, b)\"]}\n";
    // Momentum is conserved to rounding; angular momentum to the scheme's own error, of second order.
    const auto gained = [&](double h) {
      Vector3d p, L, left;
      bool first = true;
      move(
          text, h, 1,
          [&](const Session& session) {
            if (first) {
              p = momentum(session);
              L = angular_momentum(session);
              first = false;
            }
            CHECK((momentum(session) - p).norm() < 1e-9);
            left = angular_momentum(session) - L;
          },
          true);
      return Eigen::VectorXd(left);
    };
    CAPTURE(axes);
    bielle::test::check_second_order(gained, 4e-3, 2, 0.1, 0.05);
  }
}

TEST_CASE("a force along the line of two nodes does as a spring and damper") {
  const std::string spring =
      bodies + "  s: {type: spring_damper, nodes: [a, b], stiffness: 40, damping: 3, length: 1}\n";
  // The unit vector from a to b is computed by measures of positions.
  const std::string law =
      "(40*(distance(a, b) - 1) + 3*((b.position.x - a.position.x)*(b.velocity.x - a.velocity.x) + "
      "(b.position.y - a.position.y)*(b.velocity.y - a.velocity.y) + (b.position.z - "
      "a.position.z)*(b.velocity.z - a.velocity.z))/distance(a, b))/distance(a, b)";
  std::string force = bodies + "  s: {type: node_force, nodes: [a, b], axes: inertial, force: [";
  for (const char* axis : {"x", "y", "z"})
    force += std::string(axis[0] == 'x' ? "" : ", ") + "\"-(b.position." + axis + " - a.position." + axis + ")*" + law +
             "\"";
  force += "]}\n";
  std::vector<Vector3d> seen;
  for (const std::string& text : {spring, force})
    move_to(text, 0.01, 1, [&](const Session& session) { seen.push_back(session.node("b").x); });
  CHECK((seen[0] - seen[1]).norm() < 1e-9);
}
