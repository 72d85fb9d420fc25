// Prescribed motions with corners: impulses accelerate and stop bodies, and the user gets a warning.
#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

using namespace bielle::mechanism;
using Catch::Contains;

namespace {

/// Returns the warnings about a mass of 2 kg that a drive moves along a slide.
std::vector<std::string> warnings_of(const std::string& displacement) {
  const MechanismFile file = read_mechanism_text(R"yaml(
nodes: {b: {position: [0, 0, 0]}}
elements: {m: {type: rigid_body, node: b, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {s: {type: prismatic, nodes: [ground, b], axis: [1, 0, 0]}}
drives: {lift: {joint: s, displacement: ")yaml" + displacement +
                                                     "\"}}\n",
                                                 "model.yaml");
  Session session(file.model);
  DynamicsOptions options;
  options.duration = 0.5;
  options.stepping.size = 0.01;
  Motion motion = session.dynamics(options);
  REQUIRE(motion.finish());
  return motion.warnings();
}

}  // namespace

TEST_CASE("a prescribed motion with corners is told, with the work of the first impulse") {
  // From rest to 3 m/s at 0.105 s, and back at 0.3 s: m v (v + 0) = 18 J by the drive, half of which is lost.
  const std::vector<std::string> warnings = warnings_of("0.585*ramp(t, 0.105, 0.3)");
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("2 times") && Contains("t = 0.105 s") && Contains("drive 'lift'"));
  CHECK_THAT(warnings[0], Contains("work is 18 J"));
}

TEST_CASE("a prescribed motion whose rate is continuous gives no warning, also where its acceleration jumps") {
  CHECK(warnings_of("0.1*sin(20*t)").empty());
  CHECK(warnings_of("(t > 0.105)*(t - 0.105)^2").empty());
}

TEST_CASE("a smooth start of a crank gives no warning, though velocities of coarse steps have errors") {
  // The kink of `step` at its end is in its third derivative. With 31 steps per turn the restart there changes
  // the velocities of the rod's scheme by (omega h)^2/12 of theirs.
  const MechanismFile file = read_mechanism_text(R"yaml(
nodes: {crank: {position: [0, 0, 0]}, rod: {position: [0.15, 0, 0]}, piston: {position: [0.25, 0, 0]}}
elements:
  crank: {type: rigid_body, node: crank, mass: 3, inertia: [0.004, 0.004, 0.007]}
  rod: {type: rigid_body, node: rod, mass: 0.8, inertia: [0.0003, 0.005, 0.005]}
  piston: {type: rigid_body, node: piston, mass: 0.6, inertia: [0.001, 0.001, 0.001]}
joints:
  main: {type: hinge, nodes: [ground, crank], position: [0, 0, 0], axis: [0, 0, 1]}
  pin: {type: hinge, nodes: [crank, rod], position: [0.05, 0, 0], axis: [0, 0, 1]}
  wrist: {type: spherical, nodes: [piston, rod], position: [0.25, 0, 0]}
  guide: {type: prismatic, nodes: [ground, piston], position: [0.25, 0, 0], axis: [1, 0, 0]}
drives: {motor: {joint: main, rate: "314*step(t, 0, 0.0201)"}}
)yaml",
                                                 "model.yaml");
  Session session(file.model);
  DynamicsOptions options;
  options.duration = 0.04;
  options.stepping.size = 2e-4;
  Motion motion = session.dynamics(options);
  REQUIRE(motion.finish());
  CHECK(motion.warnings().empty());
}
