// Actions of events: what is released falls, flies or swings on, what is locked or activated is joined by an impulse.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/session/session.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/second_order.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::check_second_order;
using bielle::test::message_of;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;

namespace test_event_actions {
namespace {

Vector3 position(const Session& session, const std::string& node) {
  return session.state().nodes[static_cast<std::size_t>(*session.model().find_node(node))].x;
}
Vector3 velocity(const Session& session, const std::string& node) {
  return session.state().nodes[static_cast<std::size_t>(*session.model().find_node(node))].v;
}
double value(const Session& session, const std::string& dataset) { return session.read(dataset)[0]; }

/// Returns a mass on a component that holds it 1 m below the ground until an instant.
std::string held_mass(const std::string& holder, double time) {
  return fmt::format(R"yaml(
gravity: [0, 0, -10]
nodes: {{mass: {{position: [0, 0, -1], fixed: [rx, ry, rz]}}}}
elements: {{mass: {{type: point_mass, node: mass, mass: 2}}}}
joints: {{{}}}
states: {{clock: {{rate: 1}}}}
events: {{now: {{when: clock, crosses: {:.17g}, do: [{{release: holder}}]}}}}
)yaml",
                     holder, time);
}

}  // namespace

TEST_CASE("a released contact, bushing or load acts no more") {
  // Both bodies start in equilibrium: the floor carries m g = 10 N at the depth (m g / k)^(2/3), and the bushing by its
  // preload. The push of 3 N along the floor, which has no friction, ends as well.
  const double time = GENERATE(0.1, 0.1037);
  const double g = 10, depth = std::pow(g / 1e6, 2.0 / 3);
  Session session = session_of(fmt::format(R"yaml(
gravity: [0, 0, -10]
nodes: {{ball: {{position: [0, 0, {:.17g}]}}, hung: {{position: [5, 0, 0]}}}}
elements:
  ball: {{type: rigid_body, node: ball, mass: 1, inertia: [0.1, 0.1, 0.1]}}
  hung: {{type: rigid_body, node: hung, mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints:
  floor: {{type: contact, shapes: [{{node: ground, plane: [0, 0, 1]}}, {{node: ball, sphere: 0.1}}], stiffness: 1e6}}
  bush: {{type: bushing, nodes: [ground, hung], stiffness: [1e4, 1e4, 1e4, 10, 10, 10], preload: [0, 0, -10, 0, 0, 0]}}
loads: {{push: {{node: ball, force: [3, 0, 0]}}}}
states: {{clock: {{rate: 1}}}}
events: {{now: {{when: clock, crosses: {:.17g}, do: [{{release: floor}}, {{release: bush}}, {{release: push}}]}}}}
)yaml",
                                           0.1 - depth, time));
  Motion motion = session.dynamics(steps_of(0.4, 0.005));
  motion.advance_to(0.09);
  CHECK(position(session, "ball").z() == Approx(0.1 - depth).epsilon(1e-9));
  CHECK(std::abs(position(session, "hung").z()) < 1e-12);
  motion.finish();
  const double left = 0.4 - time, fall = g / 2 * left * left;
  CHECK(position(session, "ball").z() == Approx(0.1 - depth - fall).epsilon(1e-6));
  CHECK(position(session, "hung").z() == Approx(-fall).epsilon(1e-6));
  CHECK(velocity(session, "ball").x() == Approx(3 * time).epsilon(1e-6));
}

TEST_CASE("a mass falls freely from the instant at which its link is released") {
  const std::string holder =
      GENERATE("holder: {type: distance, nodes: [ground, mass]}", "holder: {type: rigid, nodes: [ground, mass]}",
               "holder: {type: hinge, nodes: [ground, mass], axis: [0, 1, 0], position: [0, 0, 0]}",
               "holder: {type: point_on_plane, nodes: [ground, mass], normal: [0, 0, 1], position: [0, 0, -1]}");
  const double time = GENERATE(0.25, 0.2613, 0.249999999);  // on the grid of steps, off it, just before it
  CAPTURE(holder, time);
  for (const double h : {0.05, 0.01}) {
    Session session = session_of(held_mass(holder, time));
    Motion motion = session.dynamics(steps_of(0.7, h));
    motion.advance_to(0.2);
    CHECK(position(session, "mass").z() == Approx(-1).epsilon(1e-12));
    motion.finish();
    // The time is located to 1e-10 of a step; a parabola is exact for the scheme.
    CHECK(std::abs(position(session, "mass").z() + 1 + 5 * std::pow(0.7 - time, 2)) < 1e-9);
    CHECK(std::abs(velocity(session, "mass").z() + 10 * (0.7 - time)) < 1e-9);
    CHECK(std::abs(motion.energy().dissipation) < 1e-9);
    CHECK(std::abs(motion.balance()) < 1e-9);
    CHECK(motion.last_event() == "event 'now': releases 'holder'");
  }
}

TEST_CASE("a pendulum that is let go flies on with its velocity, to second order") {
  // It is released at 0.3 rad beyond the lowest point: the velocity follows from the energy, then the motion is a
  // parabola with a constant rate.
  const std::string text = R"yaml(
gravity: [0, 0, -9.81]
nodes: {arm: {position: [-0.5, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {main: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, -1, 0]}}
events: {loose: {when: main.angle, crosses: ANGLE, do: [{release: main}]}}
)yaml";
  const double J = 0.1 + 2 * 0.25, turned = M_PI / 2 + 0.3;
  const double w = std::sqrt(2 * 2 * 9.81 * 0.5 * std::sin(turned) / J);
  std::string model = text;
  model.replace(model.find("ANGLE"), 5, fmt::format("{:.17g}", turned));
  const auto error = [&](double h) {
    Session session = session_of(model);
    Motion motion = session.dynamics(steps_of(1.2, h));
    motion.finish();
    const NodeState& arm = session.state().nodes[1];
    CHECK(value(session, "joints/main/reaction") == 0);
    // The horizontal velocity stays, the rate, and the energy of the centre, which was at the distance 0.5.
    const double energy = 0.125 * w * w - 9.81 * 0.5 * std::sin(turned);
    return Vector3(arm.v.x() - 0.5 * w * std::sin(turned), arm.Omega.norm() - w,
                   arm.v.squaredNorm() / 2 + 9.81 * arm.x.z() - energy)
        .norm();
  };
  // The instant lies at an arbitrary place within a step: the factor of h^2 varies slightly with this place.
  double before = error(0.008);
  for (const double h : {0.004, 0.002, 0.001}) {
    const double now = error(h);
    CHECK(before / now == Approx(4).margin(0.5));
    before = now;
  }
}

TEST_CASE("two carriages that couple keep their momentum, and lose the energy of their relative motion") {
  const double h = GENERATE(0.01, 0.0037);
  const std::string action = GENERATE("lock: buffer", "lock: buffer.displacement", "activate: hook");
  CAPTURE(h, action);
  // 3 kg at 2 m/s behind 1 kg at rest; they meet after 0.5 m.
  Session session = session_of(R"yaml(
nodes:
  a: {position: [0, 0, 0], velocity: [2, 0, 0], fixed: [y, z, rx, ry, rz]}
  b: {position: [0.5, 0, 0], fixed: [y, z, rx, ry, rz]}
elements: {a: {type: point_mass, node: a, mass: 3}, b: {type: point_mass, node: b, mass: 1}}
joints:
  buffer: {type: prismatic, nodes: [a, b], axis: [1, 0, 0]}
  hook: {type: rigid, nodes: [b, a], at: [[0, 0, 0], [0, 0, 0]], active: false}
measures: {gap: b.position.x - a.position.x}
events: {meet: {when: gap, direction: falling, do: [{)yaml" +
                               action + "}]}}\n");
  Motion motion = session.dynamics(steps_of(1, h));
  motion.advance_to(0.2);
  CHECK(velocity(session, "b").x() == 0);
  motion.finish();
  CHECK(velocity(session, "a").x() == Approx(1.5).epsilon(1e-12));
  CHECK(velocity(session, "b").x() == Approx(1.5).epsilon(1e-12));
  CHECK(position(session, "a").x() == Approx(0.5 + 1.5 * 0.75).epsilon(1e-9));
  CHECK(std::abs(position(session, "b").x() - position(session, "a").x()) < 1e-9);
  CHECK(motion.energy().dissipation == Approx(0.5 * 3 * 1 / 4.0 * 4).epsilon(1e-10));
  CHECK(std::abs(motion.balance()) < 1e-10);
}

TEST_CASE("a spring that is released leaves the velocity, and its energy is dissipated") {
  // x = 0.1 cos(20 t): the mass passes 0.06 at 1.6 m/s.
  const std::string model = R"yaml(
nodes: {mass: {position: [1.1, 0, 0], fixed: [y, z, rx, ry, rz]}}
elements:
  mass: {type: point_mass, node: mass, mass: 1}
  spring: {type: spring_damper, nodes: [ground, mass], stiffness: 400, length: 1}
measures: {force: spring.force}
events: {go: {when: mass.position.x, crosses: 1.06, do: [{release: spring}]}}
)yaml";
  check_second_order(
      [&](double h) {
        Session session = session_of(model);
        Motion motion = session.dynamics(steps_of(0.3, h));
        motion.advance_to(0.02);
        CHECK(std::abs(value(session, "measures/force")) > 20);
        motion.finish();
        CHECK(value(session, "measures/force") == 0);
        CHECK(value(session, "elements/spring/force") == 0);
        CHECK(motion.energy().elastic == 0);
        CHECK(motion.energy().dissipation == Approx(200 * 0.06 * 0.06).epsilon(1e-6));
        const double since = 0.3 - std::acos(0.6) / 20;
        return Eigen::Vector2d(velocity(session, "mass").x() + 1.6, position(session, "mass").x() - 1.06 + 1.6 * since);
      },
      0.002, 3);
}

TEST_CASE("a spring that is activated while it is stretched supplies its energy, and swings") {
  // At 0.5 m the free mass at 1 m/s meets a spring that is free at 0.2 m: the amplitude follows from the energy.
  const std::string model = R"yaml(
nodes: {mass: {position: [0, 0, 0], velocity: [1, 0, 0], fixed: [y, z, rx, ry, rz]}, wall: {position: [-1, 0, 0], fixed: true}}
elements:
  mass: {type: point_mass, node: mass, mass: 1}
  spring: {type: spring_damper, nodes: [wall, mass], stiffness: 100, length: 1.2, active: false}
events: {hook: {when: mass.position.x, crosses: 0.5, do: [{activate: spring}]}}
)yaml";
  check_second_order(
      [&](double h) {
        Session session = session_of(model);
        Motion motion = session.dynamics(steps_of(1, h));
        motion.advance_to(0.4);
        CHECK(velocity(session, "mass").x() == 1);
        motion.finish();
        CHECK(motion.energy().input == Approx(50 * 0.09).epsilon(1e-9));
        CHECK(motion.energy().dissipation == 0);
        const double x = 0.3 * std::cos(10 * 0.5) + 0.1 * std::sin(10 * 0.5);
        const double v = -3 * std::sin(10 * 0.5) + std::cos(10 * 0.5);
        return Eigen::Vector2d(position(session, "mass").x() - 0.2 - x, velocity(session, "mass").x() - v);
      },
      0.004, 3);
}

TEST_CASE("a mast of two links that latches keeps its angular momentum about the base") {
  // The lower link turns about the origin; the upper one turns faster about the knee, until they are in line.
  const std::string model = R"yaml(
nodes:
  lower: {position: [0.5, 0, 0], velocity: [0, 0.5, 0], angular_velocity: [0, 0, 1]}
  upper: {position: [1, -0.4, 0], velocity: [1.2, 1, 0], angular_velocity: [0, 0, 3]}
elements:
  lower: {type: rigid_body, node: lower, mass: 2, inertia: [0.1, 0.1, 0.2]}
  upper: {type: rigid_body, node: upper, mass: 1, inertia: [0.1, 0.1, 0.05]}
joints:
  base: {type: hinge, nodes: [ground, lower], position: [0, 0, 0], axis: [0, 0, 1]}
  knee: {type: hinge, nodes: [lower, upper], position: [1, 0, 0], axis: [0, 0, 1]}
events: {straight: {when: knee.angle, crosses: 1.5707963267948966, do: [{lock: knee}]}}
)yaml";
  // At the start: r x m v + J w of both links.
  const double before = 2 * 0.5 * 0.5 + 0.2 * 1 + (1 * 1.0 * 1 + 0.4 * 1.2) + 0.05 * 3;
  const double inertia = 2 * 0.25 + 0.2 + 1.4 * 1.4 + 0.05, w = before / inertia;
  const double energy = 0.5 * (2 * 0.25 + 0.2 + 1.0 * (1.44 + 1) + 0.05 * 9);
  check_second_order(
      [&](double h) {
        Session session = session_of(model);
        Motion motion = session.dynamics(steps_of(1.5, h));
        motion.finish();
        CHECK(motion.log().crossings == 1);
        CHECK(std::abs(value(session, "joints/knee/rate")) < 1e-12);
        CHECK(value(session, "joints/knee/coordinate") == Approx(M_PI / 2).epsilon(1e-9));
        return Eigen::Vector3d(value(session, "joints/base/rate") - w, motion.energy().kinetic - inertia * w * w / 2,
                               motion.energy().dissipation - (energy - inertia * w * w / 2));
      },
      0.01, 2);
}

TEST_CASE("an input that is set makes another piece of the oscillation") {
  // x'' = 100 (command - x): about 0 up to x = 0 at -1 m/s, then about 0.3.
  const std::string model = R"yaml(
nodes: {mass: {position: [0.1, 0, 0], fixed: [y, z, rx, ry, rz]}}
elements: {mass: {type: point_mass, node: mass, mass: 1}}
inputs: {command: 0}
loads: {push: {node: mass, force: ["100*(command - mass.position.x)", 0, 0]}}
events: {switch: {when: mass.position.x, direction: falling, do: [{set: {command: "command - 0.3*mass.velocity.x"}}]}}
)yaml";
  check_second_order(
      [&](double h) {
        Session session = session_of(model);
        Motion motion = session.dynamics(steps_of(0.6, h));
        motion.finish();
        const double angle = 10 * (0.6 - M_PI / 20);
        const double x = 0.3 - 0.3 * std::cos(angle) - 0.1 * std::sin(angle);
        const double v = 3 * std::sin(angle) - std::cos(angle);
        return Eigen::Vector2d(position(session, "mass").x() - x, velocity(session, "mass").x() - v);
      },
      0.004, 3);
}

TEST_CASE("of two joints that repeat each other the second holds on when the first is released") {
  Session session = session_of(R"yaml(
gravity: [0, 0, -10]
nodes: {mass: {position: [1, 0, 0]}}
elements: {mass: {type: rigid_body, node: mass, mass: 2, inertia: [1, 1, 1]}}
joints:
  first: {type: rigid, nodes: [ground, mass]}
  second: {type: hinge, nodes: [ground, mass], position: [0, 0, 0], axis: [1, 0, 0]}
states: {clock: {rate: 1}}
events:
  one: {when: clock, crosses: 0.2, do: [{release: first}]}
  two: {when: clock, crosses: 0.4, do: [{activate: first}, {release: second}]}
)yaml");
  Motion motion = session.dynamics(steps_of(0.6, 0.01));
  motion.advance_to(0.3);
  CHECK(position(session, "mass").isApprox(Vector3(1, 0, 0), 1e-12));
  CHECK(session.read("joints/first/reaction")[2] == 0);
  CHECK(session.read("joints/second/reaction")[0] * 0 == 0);
  motion.finish();
  CHECK(position(session, "mass").isApprox(Vector3(1, 0, 0), 1e-12));
  CHECK(value(session, "joints/second/reaction") == 0);
}

TEST_CASE("a joint that is activated where its parts do not meet is refused with its gap") {
  const std::string text = R"yaml(
nodes: {mass: {position: [0, 0, 0], velocity: [1, 0, 0], fixed: [y, z, rx, ry, rz]}, end: {position: [0.5, 0, 0], fixed: true}}
elements: {mass: {type: point_mass, node: mass, mass: 1}}
joints: {catch: {type: rigid, nodes: [end, mass], at: [[0, 0, 0], [0, 0, 0]], active: false}}
events: {late: {when: mass.position.x, crosses: PLACE, do: [{activate: catch}]}}
)yaml";
  const auto run = [&](const std::string& place) {
    std::string model = text;
    model.replace(model.find("PLACE"), 5, place);
    Session session = session_of(model);
    Motion motion = session.dynamics(steps_of(1, 0.01));
    motion.finish();
    return velocity(session, "mass").x();
  };
  CHECK_THAT(message_of<ComputationError>([&] { run("0.49"); }),
             Contains("joint 'catch' cannot be activated: it is open by 0.01 m") &&
                 Contains("event 'late': activates 'catch'"));
  CHECK(std::abs(run("0.5")) < 1e-12);
}

}  // namespace test_event_actions
