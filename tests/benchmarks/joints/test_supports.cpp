// Forces of supports: statics of beams, weights, moving bases, and the sum over all of them.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/analyses/statics.hpp"
#include "tests/benchmarks/joints/moved.hpp"

using bielle::mechanism::Session;
using bielle::test::move;

namespace {

std::vector<double> support(const Session& session, const std::string& node) {
  return session.read("supports/" + node + "/reaction");
}

}  // namespace

TEST_CASE("the clamp of a cantilever bears its load and its weight") {
  // 2 m of 3 kg/m carry 10 N at the end: force 10 + 6 g, moment 10 l + 6 g l/2 about -y; the deflection is small.
  const std::string text = R"yaml(
gravity: [0, 0, -9.81]
nodes:
  a: {fixed: true}
  b: {position: [2, 0, 0]}
elements:
  beam: {type: beam, nodes: [a, b], elements: 6, orientation: [0, 1, 0],
         section: {EA: 8e9, GAy: 3e9, GAz: 3e9, GJ: 1e8, EIy: 1e8, EIz: 1e8, mass_per_length: 3, Jx: 1e-4, Jy: 1e-4, Jz: 1e-4}}
loads: {weight: {node: b, force: [0, 0, -10]}}
)yaml";
  const bielle::mechanism::MechanismFile file = bielle::mechanism::read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  compute_statics(session);
  const std::vector<double> f = support(session, "a");
  CHECK(f[2] == Approx(10 + 6 * 9.81).epsilon(1e-8));
  CHECK(f[4] == Approx(-(20 + 6 * 9.81)).epsilon(1e-5));
  CHECK(std::abs(f[0]) < 1e-6);
}

TEST_CASE("a base that is shaken bears the inertia of what it carries, at its own place") {
  // 2 kg on a carried node 0.5 m to the side: force m a, moment from the arm; a drive's reaction on its base.
  const std::string text = R"yaml(
nodes:
  base: {motion: {z: "0.1*sin(5*t)"}, fixed: [x, y, rx, ry, rz]}
  top: {position: [0.5, 0, 0]}
  arm: {position: [0, 0, 1]}
elements:
  b: {type: rigid_body, node: base, mass: 1, inertia: [1, 1, 1], also: [top]}
  m: {type: point_mass, node: top, mass: 2}
  w: {type: rigid_body, node: arm, mass: 1, inertia: [0.1, 0.1, 0.15]}
joints: {hinge: {type: hinge, nodes: [base, arm], axis: [0, 0, 1]}}
drives: {motor: {joint: hinge, torque: 0.6}}
)yaml";
  move(text, 1e-3, 1, [](const Session& session) {
    const double acceleration = -2.5 * std::sin(5 * session.time());
    const std::vector<double> f = support(session, "base");
    CHECK(f[2] == Approx(4 * acceleration).margin(2e-3));
    CHECK(f[4] == Approx(-0.5 * 2 * acceleration).margin(1e-3));
    CHECK(f[5] == Approx(0.6).epsilon(1e-6));  // the motor's torque on the arm comes from the base
  });
}

TEST_CASE("supports of free directions bear nothing, and all together the weight") {
  const std::string text = R"yaml(
gravity: [0, 0, -9.81]
nodes:
  left: {fixed: true}
  right: {position: [3, 0, 0], fixed: [y, z, rx, ry, rz]}
  middle: {position: [1, 0, 0]}
elements:
  l: {type: spring_damper, nodes: [left, right], stiffness: 10}
  b: {type: rigid_body, node: middle, mass: 4, inertia: [1, 1, 1]}
joints:
  j1: {type: spherical, nodes: [left, middle], position: [0, 0, 0]}
  j2: {type: spherical, nodes: [right, middle], position: [3, 0, 0]}
)yaml";
  const bielle::mechanism::MechanismFile file = bielle::mechanism::read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  bielle::mechanism::DynamicsOptions options;
  options.duration = 0.1;
  options.stepping.size = 0.01;
  session.dynamics(options).finish();
  const std::vector<double> left = support(session, "left"), right = support(session, "right");
  CHECK(left[2] == Approx(4 * 9.81 * 2 / 3).epsilon(1e-8));
  CHECK(right[2] == Approx(4 * 9.81 / 3).epsilon(1e-8));
  CHECK(std::abs(right[0]) < 1e-8);
  for (int k = 3; k < 6; ++k) CHECK(std::abs(left[static_cast<std::size_t>(k)]) < 1e-8);
}
