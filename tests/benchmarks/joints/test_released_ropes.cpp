// Ropes with friction that events release and activate.
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/support/session_model.hpp"

using namespace bielle::mechanism;
using bielle::test::session_of;
using bielle::test::steps_of;

namespace test_released_ropes {
namespace {

/// Returns masses of 2 and 1 kg that slip over a bollard of 0.1 m, mu = 0.1, on a rope without damping.
std::string over_bollard(const std::string& type, const std::string& events) {
  return R"yaml(
gravity: [0, 0, -9.81]
nodes:
  a: {position: [-0.1, 0, -1], fixed: [x, y, rx, ry, rz]}
  bollard: {fixed: true}
  b: {position: [0.1, 0, -1], fixed: [x, y, rx, ry, rz]}
elements:
  m_a: {type: point_mass, node: a, mass: 2}
  m_b: {type: point_mass, node: b, mass: 1}
joints:
  rope: {type: cable, nodes: [a, bollard, b], radii: [0, 0.1, 0], axis: [0, 1, 0], EA: 1e4, damping: 1e-2)yaml" +
         type + "}\nmeasures: {slip: rope.bollard.slip}\nstates: {clock: {rate: 1}}\nevents: {" + events + "}\n";
}

const NodeState& node(const Session& session, const char* name) {
  return session.state().nodes[static_cast<std::size_t>(*session.model().find_node(name))];
}

}  // namespace
}  // namespace test_released_ropes
using namespace test_released_ropes;

TEST_CASE("masses fall freely from the instant at which their rope with friction is released") {
  const double time = GENERATE(0.2, 0.2037);  // at a time of the grid of steps, and between two of them
  Session session = session_of(over_bollard(
      ", friction: 0.1", "cut: {when: clock, crosses: " + std::to_string(time) + ", do: [{release: rope}]}"));
  Motion motion = session.dynamics(steps_of(0.5, 0.002));
  motion.advance_to(0.198);
  CHECK(session.measure("slip") < -0.01);
  double z = 0, v = 0, begun = 0, slip = 0;
  bool first = true;
  while (motion.step()) {
    if (session.time() < time + 1e-6) continue;
    if (first) {
      z = node(session, "a").x.z(), v = node(session, "a").v.z(), begun = session.time(),
      slip = session.measure("slip");
      first = false;
    }
    const double since = session.time() - begun;
    CHECK(node(session, "a").v.z() == Approx(v - 9.81 * since).epsilon(1e-9));
    CHECK(node(session, "a").x.z() == Approx(z + v * since - 9.81 / 2 * since * since).epsilon(1e-9));
    CHECK(session.measure("slip") == Approx(slip).epsilon(1e-12));
    for (const double tension : session.read("joints/rope/tension")) CHECK(tension == 0);
  }
  REQUIRE_FALSE(first);
  CHECK(motion.energy().elastic == 0);
  // The energy balance closes, because the energy stored in the rope is dissipated.
  CHECK(std::abs(motion.balance()) < 1e-3 * motion.energy().kinetic);
}

TEST_CASE("a rope with friction that is not active from the start holds from the event on") {
  Session session = session_of(
      over_bollard(", friction: 0.1, active: false", "hook: {when: clock, crosses: 0.001, do: [{activate: rope}]}"));
  Motion motion = session.dynamics(steps_of(0.3, 0.001));
  motion.advance_to(0.001);
  CHECK(node(session, "a").v.z() == Approx(-0.00981).epsilon(1e-9));
  motion.finish();
  for (const double tension : session.read("joints/rope/tension")) CHECK(tension > 1);
  // The rope slips: T_a = exp(mu pi) T_b, and both masses have the same acceleration. It is stretched by 3 mm
  // meanwhile.
  const double e = std::exp(0.1 * M_PI), rate = 9.81 * (2 - e) / (2 + e);
  CHECK(node(session, "a").v.z() == Approx(-rate * 0.299).epsilon(0.05));
  CHECK(node(session, "a").v.z() == Approx(-node(session, "b").v.z()).epsilon(0.05));
}

TEST_CASE("an undamped rope that is activated again slips at once to the limit of its friction") {
  // The rope has been released for 10 ms, in which both masses fell equally: its two sides have been stretched by
  // different amounts. The energy that it has afterwards is supplied, and the later energy balance closes.
  const double again = GENERATE(0.11, 0.1103);
  std::string text = over_bollard(", pretension: 60, friction: 0.1",
                                  "cut: {when: clock, crosses: 0.1, do: [{release: rope}]}, hook: {when: clock, "
                                  "crosses: " +
                                      std::to_string(again) + ", do: [{activate: rope}]}");
  const std::string damping = "damping: 1e-2";
  text.replace(text.find(damping), damping.size(), "damping: 0");
  Session session = session_of(text);
  Motion motion = session.dynamics(steps_of(0.4, 0.0002));
  bool first = true;
  double dissipated = 0;
  while (motion.step()) {
    if (session.time() < again + 1e-7) {
      dissipated = motion.energy().dissipation;
      continue;
    }
    const std::vector<double> tension = session.read("joints/rope/tension");
    if (first) {
      CHECK(tension[1] > 1);
      CHECK(tension[0] == Approx(std::exp(0.1 * M_PI) * tension[1]).epsilon(1e-6));
      CHECK(motion.energy().dissipation - dissipated < 0.01 * motion.energy().kinetic);
      first = false;
    }
  }
  REQUIRE_FALSE(first);
  CHECK(std::abs(motion.balance()) < 1e-3 * motion.energy().kinetic);
}
