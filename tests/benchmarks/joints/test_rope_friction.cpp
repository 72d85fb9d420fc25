// Ropes with friction on pulleys and bollards, against the capstan equation T_2 = exp(mu theta) T_1.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/messages.hpp"

using namespace bielle::mechanism;
using bielle::test::move;
using bielle::test::move_to;

namespace test_rope_friction {
namespace {

constexpr double g = 9.81;

/// Returns two masses on a rope over a drum of 0.1 m on a hinge about y; `second` is at x = +0.1, and z = -1 for both.
/// @param held  keys of the drum's node
std::string over_drum(double first, double second, const std::string& held, const std::string& keys) {
  return fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes:
  a: {{position: [-0.1, 0, -1], fixed: [x, y, rx, ry, rz]}}
  drum: {{{}}}
  b: {{position: [0.1, 0, -1], fixed: [x, y, rx, ry, rz]}}
elements:
  m_a: {{type: point_mass, node: a, mass: {}}}
  m_b: {{type: point_mass, node: b, mass: {}}}
joints:
  rope: {{type: cable, nodes: [a, drum, b], radii: [0, 0.1, 0], axis: [0, 1, 0], EA: 1e6, damping: 1e-3{}}}
)yaml",
                     held, first, second, keys);
}

struct Moved {
  double balance = 0, dissipated = 0;
  std::vector<std::string> events;
};

Moved account(const std::string& text, double h, double end, const bielle::test::Look& look = {}) {
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  Moved moved;
  session.on_event([&](const Event& event) { moved.events.push_back(event.name); });
  DynamicsOptions options;
  options.duration = end;
  options.stepping.size = h;
  Motion motion = session.dynamics(options);
  while (motion.step())
    if (look) look(session);
  moved.balance = motion.balance();
  moved.dissipated = motion.energy_balance().totals().dissipation;
  return moved;
}

}  // namespace
}  // namespace test_rope_friction

using namespace test_rope_friction;

TEST_CASE("a rope slips over a fixed drum with the tensions of the capstan equation") {
  // m_b (g - a) = k m_a (g + a), k = exp(mu pi); either way round.
  const double mu = 0.3, k = std::exp(mu * M_PI), a = g * (10 - k * 1) / (10 + k * 1), end = 0.3;
  for (const bool forwards : {true, false}) {
    CAPTURE(forwards);
    const double sign = forwards ? 1 : -1;
    const std::string text =
        over_drum(forwards ? 1 : 10, forwards ? 10 : 1, "fixed: true", fmt::format(", friction: {}", mu));
    const Moved moved = account(text, 1e-3, end, [&](const Session& session) {
      const std::vector<double> T = session.read("joints/rope/tension");
      REQUIRE(T.size() == 2);
      if (session.time() < 0.1) return;  // after the first oscillations of the rope
      // The resistance that makes the slip unique, 1e-10 s/m EA, adds 1e-5.
      CHECK(std::max(T[0], T[1]) / std::min(T[0], T[1]) == Approx(k).epsilon(3e-5));
    });
    move_to(text, 1e-3, end, [&](const Session& session) {
      const double way = 0.5 * a * end * end;
      // The rope is longer by 1e-4 under its loads.
      CHECK(session.node(forwards ? "a" : "b").x.z() == Approx(-1 + way).margin(2e-4));
      CHECK(session.read("joints/rope/slip")[0] == Approx(sign * way).margin(3e-4));
      CHECK(session.read("joints/rope/slip_velocity")[0] == Approx(sign * a * end).epsilon(2e-3));
      CHECK(session.read("joints/rope/slips")[0] == 1);
      CHECK(session.read("joints/rope/wrap")[0] == Approx(M_PI).epsilon(1e-9));
      const double T = 1 * (g + a);
      CHECK(session.read("joints/rope/friction")[0] == Approx(sign * (k - 1) * T).epsilon(2e-3));
      CHECK(session.read("joints/rope/friction_limit")[0] == Approx((k - 1) * T).epsilon(2e-3));
    });
    const double slipped = 0.5 * a * end * end, T = 1 * (g + a);
    CHECK(moved.dissipated == Approx((k - 1) * T * slipped).epsilon(0.01));
    CHECK(std::abs(moved.balance) < 2e-3 * moved.dissipated);
    // The rope hangs without tension at first; an event of its slip may be listed.
    for (const std::string& event : moved.events) CHECK(event.find("begins to slip") != std::string::npos);
  }
}

TEST_CASE("a rope below the limit of friction does not move on its drum at all") {
  // k = 2.566: 2 kg against 1 kg hang in equilibrium; then b is shaken so that the ratio stays below 2.5.
  const std::string text = over_drum(1, 2, "fixed: true", ", friction: 0.3, pretension: 14.715") +
                           "loads: {shaker: {node: b, force: [0, 0, \"3*sin(40*t)\"]}}\n";
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  compute_statics(session);
  CHECK(session.read("joints/rope/slip")[0] == 0);
  CHECK(session.read("joints/rope/tension")[0] == Approx(g).epsilon(1e-9));
  CHECK(session.read("joints/rope/tension")[1] == Approx(2 * g).epsilon(1e-9));
  int events = 0;
  session.on_event([&](const Event&) { ++events; });
  DynamicsOptions options;
  options.duration = 2;
  options.stepping.size = 1e-3;
  Motion motion = session.dynamics(options);
  double highest = 0;
  while (motion.step()) {
    CHECK(session.read("joints/rope/slip")[0] == 0);
    CHECK(session.read("joints/rope/slip_velocity")[0] == 0);
    CHECK(session.read("joints/rope/slips")[0] == 0);
    const std::vector<double> T = session.read("joints/rope/tension");
    highest = std::max(highest, T[1] / T[0]);
  }
  CHECK(highest > 2.2);
  CHECK(events == 0);
}

TEST_CASE("further turns round a bollard multiply the friction") {
  // 2.5 turns with mu = 0.2: exp(pi) = 23.14 kg on 1 kg are held, 30 kg are not.
  const std::string keys = ", friction: [~, 0.2, ~], turns: [~, 2, ~], pretension: 100";
  move_to(over_drum(1, 23, "fixed: true", keys), 1e-3, 0.2,
          [](const Session& session) { CHECK(session.read("joints/rope/wrap")[0] == Approx(5 * M_PI).epsilon(1e-9)); });
  const double k = std::exp(M_PI), a = g * (30 - k) / (30 + k);
  double at_first = 0;  // the pretension makes the rope slip at the start as well
  move(over_drum(1, 30, "fixed: true", keys), 1e-3, 0.3, [&](const Session& session) {
    if (session.time() < 0.1501) at_first = session.read("joints/rope/slip_velocity")[0];
    if (session.time() > 0.2999)
      CHECK(session.read("joints/rope/slip_velocity")[0] - at_first == Approx(a * 0.15).epsilon(5e-3));
  });
}

TEST_CASE("an Atwood machine whose heavy pulley slips under its rope") {
  // The slip follows the capstan equation; the pulley turns by J alpha = r (T_b - T_a), more slowly than the rope.
  const double mu = 0.1, k = std::exp(mu * M_PI), a = g * (3 - k * 1) / (3 + k * 1), T = 1 * (g + a), J = 0.08,
               end = 0.4, alpha = 0.1 * (k - 1) * T / J;
  REQUIRE(0.1 * alpha < a);
  const std::string text = over_drum(1, 3, "", fmt::format(", friction: {}", mu)) +
                           "  axle: {type: hinge, nodes: [ground, drum], axis: [0, 1, 0]}\n";
  const std::string with_wheel =
      text.substr(0, text.find("joints:")) +
      fmt::format("  wheel: {{type: rigid_body, node: drum, mass: 5, inertia: [{0}, {0}, {0}]}}\n", J) +
      text.substr(text.find("joints:"));
  move_to(with_wheel, 1e-3, end, [&](const Session& session) {
    CHECK(session.read("joints/axle/rate")[0] == Approx(alpha * end).epsilon(5e-3));
    CHECK(session.node("b").v.z() == Approx(-a * end).epsilon(2e-3));
    CHECK(session.read("joints/rope/slip_velocity")[0] == Approx(a * end - 0.1 * alpha * end).epsilon(5e-3));
  });
  const Moved moved = account(with_wheel, 1e-3, end);
  CHECK(std::abs(moved.balance) < 3e-3 * moved.dissipated);
}

TEST_CASE("a light pulley turns with its rope and does not slip") {
  // (m_b - m_a) g = (m_a + m_b + J/r^2) a
  const double J = 0.005, a = g * (1.5 - 1) / (2.5 + J / 0.01), end = 0.4;
  const std::string text = over_drum(1, 1.5, "", ", friction: 0.3, pretension: 12") +
                           "  axle: {type: hinge, nodes: [ground, drum], axis: [0, 1, 0]}\n";
  const std::string with_wheel =
      text.substr(0, text.find("joints:")) +
      fmt::format("  wheel: {{type: rigid_body, node: drum, mass: 5, inertia: [{0}, {0}, {0}]}}\n", J) +
      text.substr(text.find("joints:"));
  move_to(with_wheel, 1e-3, end, [&](const Session& session) {
    CHECK(session.read("joints/rope/slip")[0] == 0);
    CHECK(session.read("joints/axle/rate")[0] == Approx(a * end / 0.1).epsilon(2e-3));
  });
}

TEST_CASE("a rope whose other end is slack runs over its drum without friction") {
  // The end a is raised faster than the load falls.
  const std::string text = R"yaml(
gravity: [0, 0, -9.81]
nodes:
  a: {position: [-0.1, 0, -1], motion: {x: 0, y: 0, z: "3*t", rx: 0, ry: 0, rz: 0}}
  drum: {fixed: true}
  b: {position: [0.1, 0, -1], fixed: [x, y, rx, ry, rz]}
elements: {m: {type: point_mass, node: b, mass: 4}}
joints: {rope: {type: cable, nodes: [a, drum, b], radii: [0, 0.1, 0], axis: [0, 1, 0], EA: 1e5, damping: 1e-3, friction: 0.5}}
)yaml";
  move(text, 1e-3, 0.25, [](const Session& session) {
    CHECK(session.node("b").x.z() == Approx(-1 - 0.5 * g * session.time() * session.time()).margin(1e-5));
    CHECK(session.read("joints/rope/tension")[0] == 0);
    CHECK(session.read("joints/rope/tension")[1] == Approx(0).margin(1e-3));
  });
}

TEST_CASE("the friction of a rope follows its wrap as its end moves away from the drum") {
  // The end b moves sideways from below the drum's rim: the straight rope has the length l = sqrt(d^2 - r^2), with the
  // distance d of b from the drum's centre, and turns up by gamma. The wrap is pi - gamma.
  const std::string text = R"yaml(
nodes:
  a: {position: [-0.1, 0, -1], fixed: true}
  drum: {fixed: true}
  b: {position: [0.1, 0, -1], motion: {x: "t", y: 0, z: 0, rx: 0, ry: 0, rz: 0}}
joints: {rope: {type: cable, nodes: [a, drum, b], radii: [0, 0.1, 0], axis: [0, 1, 0], EA: 1e6, pretension: 100, friction: 0.4}}
)yaml";
  move(text, 5e-3, 1, [](const Session& session) {
    const double x = 0.1 + session.time(), d = std::hypot(x, 1.0);
    // The radius to the point of tangency is at the angle acos(r/d) above that to b.
    const double from_x = -std::atan2(1.0, x) + std::acos(0.1 / d);
    CHECK(session.read("joints/rope/wrap")[0] == Approx(M_PI - from_x).epsilon(1e-9));
    const std::vector<double> T = session.read("joints/rope/tension");
    if (session.read("joints/rope/slips")[0] == 1)
      CHECK(T[1] / T[0] == Approx(std::exp(0.4 * (M_PI - from_x))).epsilon(1e-6));
    else
      CHECK(session.time() < 0.1);
  });
}

TEST_CASE("friction where a rope cannot slip is refused with the reason") {
  const auto message = [](const std::string& keys) {
    return bielle::test::message_of<bielle::InputError>(
        [&] { read_mechanism_text(over_drum(1, 2, "fixed: true", keys), "model.yaml"); });
  };
  CHECK_THAT(message(", friction: [~, 0.3, ~], grips: [drum]"),
             Catch::Contains("friction[2]: is for pulleys on which"));
  CHECK_THAT(message(", friction: 0.3, grips: [drum]"), Catch::Contains("no pulley on which the rope could slip"));
  CHECK_THAT(message(", friction: [0.3, ~, ~]"), Catch::Contains("friction[1]: is for pulleys on which"));
  CHECK_THAT(message(", friction: [~, .nan, ~]"), Catch::Contains("friction[2]"));
  CHECK_THAT(message(", friction: -0.3"), Catch::Contains("friction") && Catch::Contains("-0.3"));
}

TEST_CASE("a rope on a pulley without friction has one tension, as one that slides freely") {
  // m_b (g - a) = m_a (g + a)
  const double a = g / 3;
  move_to(over_drum(1, 2, "fixed: true", ", friction: 0"), 1e-3, 0.3, [&](const Session& session) {
    const std::vector<double> T = session.read("joints/rope/tension");
    CHECK(T[0] == Approx(T[1]).epsilon(1e-4));
    CHECK(session.node("b").v.z() == Approx(-a * 0.3).epsilon(5e-3));
  });
}

TEST_CASE("statics names the pulley whose friction is too small, with its tensions") {
  const auto message = [](double first, double second, const std::string& keys) {
    return bielle::test::message_of<bielle::ComputationError>([&] {
      const MechanismFile file = read_mechanism_text(over_drum(first, second, "fixed: true", keys), "model.yaml");
      Session session(file.model);
      compute_statics(session);
    });
  };
  const std::string keys = ", friction: 0.3, pretension: 60";
  CHECK_THAT(message(10, 3, keys), Catch::Contains("joint 'rope' slips on pulley 'drum'") &&
                                       Catch::Contains("98.1 N before and 29.43 N after it") &&
                                       Catch::Contains("2.566 times"));
  CHECK_THAT(message(3, 10, keys), Catch::Contains("29.43 N before and 98.1 N after it"));
  // The loads are slightly above and slightly below the limit.
  CHECK_THAT(message(10, 10 / (1.001 * std::exp(0.3 * M_PI)), keys), Catch::Contains("slips on pulley 'drum'"));
  const MechanismFile file =
      read_mechanism_text(over_drum(10, 10 / (0.999 * std::exp(0.3 * M_PI)), "fixed: true", keys), "model.yaml");
  Session session(file.model);
  compute_statics(session);
  CHECK(session.read("joints/rope/tension")[0] == Approx(98.1).epsilon(1e-6));
}

TEST_CASE("a rope whose end is drawn to its drum is named") {
  const std::string text = R"yaml(
nodes:
  a: {position: [-0.1, 0, -1], fixed: [x, y, rx, ry, rz]}
  drum: {fixed: true}
  b: {position: [0.05, 0, -0.3], motion: {x: 0, y: 0, z: "t", rx: 0, ry: 0, rz: 0}}
elements: {m: {type: point_mass, node: a, mass: 4}}
joints: {rope: {type: cable, nodes: [a, drum, b], radii: [0, 0.1, 0], axis: [0, 1, 0], EA: 1e5, friction: 0.3}}
)yaml";
  const std::string message = bielle::test::message_of<bielle::ComputationError>([&] { account(text, 7e-3, 1); });
  CHECK_THAT(message, Catch::Contains("'rope'") && Catch::Contains("'drum'") && Catch::Contains("'b'"));
}
