// Turns of nodes about axes, counted from step to step. (The laws check their derivatives.)
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/kinematics.hpp"
#include "mechanism/math/so3.hpp"
#include "mechanism/session/session.hpp"
#include "reduce/common/error.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::message_of;
using bielle::test::model_of;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;

namespace test_turn {

constexpr double spin = 7;  // [rad/s]

/// Returns a free sphere, drawn in some orientation, which turns at a constant rate about an axis fixed in space and on
/// it.
std::string sphere(const std::string& more = "") {
  return R"yaml(
nodes:
  ball: {rotation_vector: [0.4, 0.7, -0.9], velocity: [1, 2, 3], angular_velocity: [3, 2, 6]}
  other: {rotation_vector: [0.4, 0.7, -0.9], angular_velocity: [-3, -2, -6]}
elements:
  ball: {type: rigid_body, node: ball, mass: 1, inertia: [1, 1, 1]}
  other: {type: rigid_body, node: other, mass: 1, inertia: [1, 1, 1]}
measures:
  about_axis: {node: ball, relative_to: other, quantity: turn, direction: [3, 2, 6]}
  against: {node: ball, relative_to: other, quantity: turn, direction: [-3, -2, -6]}
  rate: {node: ball, relative_to: other, quantity: turn_rate, direction: [3, 2, 6]}
)yaml" + more;
}

TEST_CASE("a turn at a constant rate is counted, also if a step is longer than half a turn") {
  for (const double h : {1e-2, 0.13, 0.4}) {  // at 14 rad/s
    CAPTURE(h);
    Session session = session_of(sphere());
    Motion motion = session.dynamics(steps_of(5 * h, h));
    for (int k = 1; k <= 5; ++k) {
      motion.step();
      CHECK(session.measure("about_axis") == Approx(2 * spin * session.time()).epsilon(1e-12));
      CHECK(session.measure("against") == Approx(-2 * spin * session.time()).epsilon(1e-12));
      CHECK(session.measure("rate") == Approx(2 * spin).epsilon(1e-12));
    }
  }
}

/// Returns a node that is carried by three driven hinges, about z, x and z as drawn, so that R = Rz(a) Rx(b) Rz(c).
/// @param upright  their z axis as drawn, in their own axes
std::string gimbals(const std::string& drawn, const Vector3& upright) {
  return "nodes:\n  outer: {" + drawn + "}\n  inner: {" + drawn + "}\n  rotor: {" + drawn + R"yaml(}
joints:
  precession: {type: hinge, nodes: [ground, outer], position: [0, 0, 0], axis: [0, 0, 1]}
  tilt: {type: hinge, nodes: [outer, inner], position: [0, 0, 0], axis: [1, 0, 0]}
  spin: {type: hinge, nodes: [inner, rotor], position: [0, 0, 0], axis: [0, 0, 1]}
drives:
  precession: {joint: precession, angle: 3*t}
  tilt: {joint: tilt, angle: 2.9*sin(t)^2}
  spin: {joint: spin, angle: -11*t + t^2}
measures:
  turn: rotor.turn.z
  rate: rotor.turn.z.rate
  in_tilt: {node: rotor, relative_to: inner, quantity: turn, direction: )yaml" +
         fmt::format("[{:.17g}, {:.17g}, {:.17g}]}}\n", upright.x(), upright.y(), upright.z());
}

TEST_CASE("precession and spin of a tilted rotor add up to its turn about the upright axis") {
  for (const Vector3& drawn : {Vector3(0, 0, 0), Vector3(0.5, -0.8, 1.1)}) {
    CAPTURE(drawn.norm());
    Session session = session_of(gimbals(fmt::format("rotation_vector: [{}, {}, {}]", drawn.x(), drawn.y(), drawn.z()),
                                         exp_so3(drawn).row(2).transpose()));
    KinematicsOptions options;
    options.duration = 6;
    options.step = 0.05;
    int points = 0;
    session.on_step([&](const Session& now) {
      const double t = now.time(), spin_angle = -11 * t + t * t, spin_rate = -11 + 2 * t;
      CHECK(now.measure("turn") == Approx(3 * t + spin_angle).margin(1e-9));
      // The rate of the turn is that of the sum, although the angular velocity about z is another one.
      CHECK(now.measure("rate") == Approx(3 + spin_rate).margin(1e-7));
      CHECK(now.measure("in_tilt") == Approx(spin_angle).margin(1e-9));
      CHECK(now.measure("in_tilt") == Approx(now.measure("spin.angle")).margin(1e-9));
      ++points;
    });
    compute_kinematics(session, options);
    CHECK(points > 100);
  }
}

TEST_CASE("an event is located at a number of turns, and rejected steps do not count") {
  const std::string event = "events: {third: {when: ball.turn.z, crosses: 9.42477796076938, action: restart}}\n";
  Session session(model_of(R"yaml(
nodes: {ball: {angular_velocity: [0, 0, 7]}}
elements: {ball: {type: rigid_body, node: ball, mass: 1, inertia: [1, 1, 1]}}
)yaml" + event));
  std::vector<Event> events;
  session.on_event([&](const Event& each) { events.push_back(each); });
  session.dynamics(steps_of(2, 0.3)).finish();
  REQUIRE(events.size() == 1);
  CHECK(events[0].time == Approx(3 * M_PI / 7).epsilon(1e-9));
  CHECK(session.measure("ball.turn.z") == Approx(14).epsilon(1e-12));
}

TEST_CASE("turns are kept by what is saved") {
  Session session = session_of(sphere());
  Motion motion = session.dynamics(steps_of(3, 0.1));
  motion.advance_to(1.5);
  const std::vector<double> saved = session.save();
  const double there = session.measure("about_axis");
  CHECK(there == Approx(3 * spin).epsilon(1e-12));
  motion.finish();
  const double end = session.measure("about_axis");
  Session other = session_of(sphere());
  Motion again = other.dynamics(steps_of(3, 0.1), saved);
  CHECK(other.measure("about_axis") == there);
  again.finish();
  CHECK(other.measure("about_axis") == end);
}

TEST_CASE("a torsion spring by the turn of a shaft stores its energy over many turns") {
  // Torque -k phi about a fixed axis with inertia J: phi = (w_0/w) sin(w t), w = sqrt(k/J), to 10 rad.
  Session session = session_of(R"yaml(
nodes: {shaft: {fixed: [x, y, z, rx, ry], angular_velocity: [0, 0, 5]}}
elements:
  shaft: {type: rigid_body, node: shaft, mass: 1, inertia: [1, 1, 2]}
loads: {spring: {node: shaft, moment: [0, 0, "-0.5*shaft.turn.z"]}}
measures: {turn: shaft.turn.z}
)yaml");
  Motion motion = session.dynamics(steps_of(8, 0.005));
  double largest = 0;
  while (motion.step()) largest = std::max(largest, std::abs(session.measure("turn")));
  CHECK(largest == Approx(10).epsilon(1e-4));
  CHECK(session.measure("turn") == Approx(10 * std::sin(4)).margin(1e-3));
}

TEST_CASE("a tilt by half a turn is told, and how to measure then") {
  Session session = session_of(R"yaml(
nodes: {arm: {fixed: [x, y, z, ry, rz]}}
elements: {arm: {type: rigid_body, node: arm, mass: 1, inertia: [1, 1, 1]}}
measures: {turn: arm.turn.z}
)yaml");
  CHECK(session.measure("turn") == 0);
  State half = session.state();
  half.nodes[1].R = exp_so3(Vector3(M_PI, 0, 0));
  session.set_state(half);
  CHECK_THAT(message_of<ComputationError>([&] { session.measure("turn"); }),
             Contains("measure 'arm.turn.z'") && Contains("tilted by half a turn"));
}

TEST_CASE("a turn that the model does not count is refused") {
  const Session session = session_of(sphere());
  CHECK_THAT(message_of<InputError>([&] { session.measure("ball.turn.z"); }),
             Contains("'ball.turn.z' is counted from step to step") && Contains("`measures`"));
  CHECK(session.measure("ball.turn.z.rate") != 0);
  CHECK_THAT(message_of<InputError>([&] { session.measure("ball.turn.q"); }), Contains("did you mean 'turn.x'?"));
}

}  // namespace test_turn
