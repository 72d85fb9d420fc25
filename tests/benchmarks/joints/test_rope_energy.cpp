// Energy of ropes that slip: the input is the work of loads and drives alone, and friction dissipates the rest.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/session_model.hpp"

using namespace bielle::mechanism;
using bielle::test::session_of;
using bielle::test::steps_of;

namespace test_rope_energy {
namespace {

/// The masses hang on a rope over a drum that is held; EA is so small that strains are several per cent.
std::string masses_on_drum(double left, double right, const std::string& more, const std::string& events = {}) {
  return fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes:
  left: {{position: [-0.1, 0, -1], fixed: [x, y, rx, ry, rz], velocity: [0, 0, {2}]}}
  drum: {{position: [0, 0, 0], fixed: true}}
  right: {{position: [0.1, 0, -1], fixed: [x, y, rx, ry, rz], velocity: [0, 0, {3}]}}
elements:
  left: {{type: point_mass, node: left, mass: {0}}}
  right: {{type: point_mass, node: right, mass: {1}}}
joints:
  rope: {{type: cable, nodes: [left, drum, right], radii: [0, 0.1, 0], axis: [0, 1, 0], EA: 5e3, pretension: 60, friction: 0.3{4}}}
{5})yaml",
                     left, right, left > right ? -2 : 2, left > right ? 2 : -2, more, events);
}

/// Returns two hinged pulleys with a belt of 1.5 % strain that slips on the first one.
std::string slipping_belt(const std::string& drives) {
  return R"yaml(
nodes: {a: {}, b: {position: [0.5, 0, 0]}}
elements:
  b1: {type: rigid_body, node: a, mass: 1, inertia: [0.01, 0.01, 0.01]}
  b2: {type: rigid_body, node: b, mass: 1, inertia: [0.02, 0.02, 0.02]}
joints:
  h1: {type: hinge, nodes: [ground, a], axis: [0, 0, 1]}
  h2: {type: hinge, nodes: [ground, b], axis: [0, 0, 1]}
  belt: {type: belt, nodes: [a, b], radii: [0.1, 0.1], axis: [0, 0, 1], EA: 2e4, pretension: 300, damping: 1e-3,
         friction: [0.3, ~]}
drives: {)yaml" +
         drives + "}\n";
}

}  // namespace
}  // namespace test_rope_energy
using namespace test_rope_energy;

TEST_CASE("friction on a drum at rest dissipates what the masses lose, in both directions") {
  const auto [left, right] = GENERATE(std::pair(20.0, 5.0), std::pair(5.0, 20.0));
  const double damping = GENERATE(0, 1e-3);
  Session session = session_of(masses_on_drum(left, right, fmt::format(", damping: {}", damping)));
  Motion motion = session.dynamics(steps_of(0.15, 2e-4));
  motion.finish();
  const double lost = motion.energy().dissipation;
  CHECK(lost > 20);
  // The strain of the rope that passes has a contribution of about 1 %.
  CHECK(std::abs(motion.energy().input) < 1e-8 * lost);
  CHECK(std::abs(motion.balance()) < 1e-4 * lost);
}

TEST_CASE("a rope that events release and activate has the energy of its activation as input alone") {
  Session session = session_of(masses_on_drum(20, 5, ", active: false", R"yaml(
states: {clock: {rate: 1}}
events:
  hook: {when: clock, crosses: 0.05, do: [{activate: rope}]}
  cut: {when: clock, crosses: 0.1, do: [{release: rope}]}
  again: {when: clock, crosses: 0.12, do: [{activate: rope}]}
)yaml"));
  Motion motion = session.dynamics(steps_of(0.2, 2e-4));
  const auto input_at = [&](double time) {
    motion.advance_to(time);
    return motion.energy().input;
  };
  CHECK(input_at(0.049) == 0);
  const double hooked = input_at(0.0502);
  CHECK(hooked > 1);
  CHECK(input_at(0.099) == Approx(hooked).epsilon(1e-8));
  CHECK(input_at(0.119) == Approx(hooked).epsilon(1e-8));
  const double again = input_at(0.1202);
  CHECK(again > hooked + 1);
  CHECK(input_at(0.2) == Approx(again).epsilon(1e-8));
}

TEST_CASE("a drum that turns below a band dissipates its own energy") {
  // The band is at rest, and its strain is constant.
  const std::string text = R"yaml(
nodes:
  anchor: {position: [-1, 0.1, 0], fixed: true}
  drum: {fixed: [x, y, z, rx, ry], angular_velocity: [0, 0, 20]}
  end: {position: [-1, -0.1, 0], fixed: true}
elements: {drum: {type: rigid_body, node: drum, mass: 10, inertia: [0.5, 0.5, 0.5]}}
joints:
  band: {type: cable, nodes: [anchor, drum, end], radii: [0, -0.1, 0], axis: [0, 0, 1], EA: 2e3, pretension: 50, friction: 0.3}
)yaml";
  Session session = session_of(text);
  Motion motion = session.dynamics(steps_of(0.5, 5e-4));
  motion.advance_to(0.1);
  const Energy before = motion.energy();
  motion.finish();
  const double lost = before.kinetic - motion.energy().kinetic;
  CHECK(lost > 5);
  CHECK(motion.energy().dissipation - before.dissipation == Approx(lost).epsilon(1e-5));
  CHECK(std::abs(motion.energy().input - before.input) < 1e-5 * lost);
}

TEST_CASE("the motor of a belt that slips gives what its load takes and its friction dissipates") {
  struct Case {
    const char* name;
    const char* drives;
  };
  const Case each = GENERATE(Case{"held", "motor: {joint: h1, rate: 20}, brake: {joint: h2, angle: 0}"},
                             Case{"running, driven by the pulley on which it slips",
                                  "motor: {joint: h1, rate: 20}, brake: {joint: h2, rate: 15}"},
                             Case{"running, driven by the pulley that it grips",
                                  "motor: {joint: h2, rate: -20}, brake: {joint: h1, rate: -15}"});
  CAPTURE(each.name);
  Session session = session_of(slipping_belt(each.drives));
  Motion motion = session.dynamics(steps_of(0.6, 1e-3));
  motion.advance_to(0.2);  // the transient is over
  const Energy before = motion.energy();
  const auto power = [&] {
    double sum = 0;
    for (const char* hinge : {"joints/h1", "joints/h2"})
      sum += session.read(fmt::format("{}/drive_force", hinge))[0] * session.read(fmt::format("{}/rate", hinge))[0];
    return sum;
  };
  const double lost_power =
      std::abs(session.read("joints/belt/friction")[0] * session.read("joints/belt/slip_velocity")[0]);
  double work = 0, last = power(), time = session.time();
  while (motion.step()) {
    const double now = power();
    work += 0.5 * (last + now) * (session.time() - time);
    last = now;
    time = session.time();
  }
  CHECK(work == Approx(0.4 * lost_power).epsilon(1e-6));
  CHECK(motion.energy().input - before.input == Approx(work).epsilon(1e-6));
  CHECK(motion.energy().dissipation - before.dissipation == Approx(work).epsilon(1e-6));
}
