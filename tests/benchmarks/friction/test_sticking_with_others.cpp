// Joints that stick, together with other parts that act in them: drives, locks, other sticking joints, statics, start
// rates, axes that turn. Each is compared with a closed form.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "tests/benchmarks/joints/moved.hpp"

using bielle::mechanism::MechanismFile;
using bielle::mechanism::read_mechanism_text;
using bielle::mechanism::Session;
using bielle::test::move;
using bielle::test::move_to;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace test_sticking_with_others {
namespace {

constexpr double m = 2, g = 9.81, mu = 0.2;

/// Returns a block of 2 kg on a horizontal guide. @param more  keys of its joint @param rest  further sections
std::string block(const std::string& more, const std::string& rest = "", const std::string& velocity = "[0, 0, 0]") {
  return fmt::format(
      "gravity: [0, 0, -9.81]\n"
      "nodes: {{block: {{position: [0, 0, 0], velocity: {}}}}}\n"
      "elements: {{block: {{type: rigid_body, node: block, mass: 2, inertia: [0.1, 0.1, 0.1]}}}}\n"
      "joints:\n"
      "  slide: {{type: prismatic, nodes: [ground, block], axis: [1, 0, 0], friction: {{model: stick_slip, "
      "coefficient: 0.2}}{}}}\n{}",
      velocity, more, rest);
}

double read(const Session& session, const char* what, const char* joint = "slide") {
  return session.read(fmt::format("joints/{}/{}", joint, what))[0];
}

}  // namespace

TEST_CASE("a drive moves a joint that sticks, through every reversal") {
  // x = sin(3 t)/3: the drive gives m x'' + mu m g sign(x').
  double longest = 0, way = 0, before = 0;
  move(block("", "drives: {d: {joint: slide, displacement: \"sin(3*t)/3\"}}\n"), 1e-2, 3, [&](const Session& session) {
    const double t = session.time(), v = std::cos(3 * t), x = std::sin(3 * t) / 3;
    way += std::abs(x - before);
    before = x;
    if (std::abs(v) < 0.05) return;  // the acceleration of the scheme oscillates for some steps after a restart
    const double wrong = read(session, "drive_force") - (-3 * m * std::sin(3 * t) + std::copysign(mu * m * g, v));
    longest = std::max(longest, std::abs(wrong));
  });
  CHECK(longest < 2e-2);  // relative to 6 N and 3.9 N, with steps of 0.01
  // The joint rests, and then moves: the drive's constraint holds it, not its friction.
  move(block("", "drives: {d: {joint: slide, displacement: \"if(t < 0.5, 0, (t - 0.5)^2)\"}}\n"), 1e-2, 1,
       [&](const Session& session) {
         if (session.time() < 0.51) return;
         CHECK_THAT(read(session, "drive_force"), WithinAbs(2 * m + mu * m * g, 1e-6));
       });
}

TEST_CASE("guides that stick side by side hold together what all of them can") {
  const std::string two = R"yaml(
gravity: [0, 0, -9.81]
nodes: {block: {position: [0, 0, 0]}}
elements: {block: {type: rigid_body, node: block, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints:
  left: {type: prismatic, nodes: [ground, block], position: [0, 0.1, 0], axis: [1, 0, 0], friction: {model: stick_slip, coefficient: 0.2}}
  right: {type: prismatic, nodes: [ground, block], position: [0, -0.1, 0], axis: [1, 0, 0], friction: {model: stick_slip, coefficient: 0.2}}
loads: {push: {node: block, force: ["4*t", 0, 0]}}
)yaml";
  const double slips = mu * m * g / 4;  // [s]
  move(two, 1e-2, 2, [&](const Session& session) {
    const double t = session.time(), x = read(session, "coordinate", "left");
    if (t < slips - 1e-9)
      CHECK_THAT(x, WithinAbs(0, 1e-12));
    else
      // 1e-4 is the scheme's own error of h^2 for a force that grows: h^2 (t - slips) 4/m in total.
      CHECK_THAT(x, WithinAbs(std::pow(t - slips, 3) * 4 / (6 * m), 1e-4 * 4 / m * (t - slips) + 1e-9));
  });
}

TEST_CASE("of two blocks on each other the one slips that must") {
  const std::string stack = R"yaml(
gravity: [0, 0, -9.81]
nodes: {a: {position: [0, 0, 0]}, b: {position: [0, 0, 0.1]}}
elements:
  a: {type: rigid_body, node: a, mass: 2, inertia: [0.1, 0.1, 0.1]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [0.1, 0.1, 0.1]}
joints:
  below: {type: prismatic, nodes: [ground, a], axis: [1, 0, 0], friction: {model: stick_slip, coefficient: 0.2}}
  between: {type: prismatic, nodes: [a, b], axis: [1, 0, 0], friction: {model: stick_slip, coefficient: 0.3}}
loads: {push: {node: b, force: ["12*sin(3*t)", 0, 0]}}
)yaml";
  // The upper joint carries at most 2.9 N, the ground 5.9 N, for any push.
  double upper = 0;
  move(stack, 1e-2, 3, [&](const Session& session) {
    CHECK_THAT(read(session, "coordinate", "below"), WithinAbs(0, 1e-12));
    upper = std::max(upper, std::abs(read(session, "rate", "between")));
  });
  CHECK(upper > 1);
}

TEST_CASE("a lock that closes on a sliding joint bears all of its load") {
  move(block(", locked: {from: 0.2, release: 8}", "loads: {push: {node: block, force: [\"20*t\", 0, 0]}}\n",
             "[1, 0, 0]"),
       1e-2, 1, [](const Session& session) {
         const double t = session.time();
         if (t > 0.2 + 1e-9 && t < 0.4 - 1e-9) {
           CHECK_THAT(read(session, "lock_force"), WithinAbs(-20 * t, 1e-9));
           CHECK(read(session, "friction") == 0);
         }
         if (t > 0.4 + 1e-9) CHECK_THAT(read(session, "friction"), WithinRel(-mu * m * g, 1e-9));
       });
}

TEST_CASE("what sticks on an axis that turns stays where it stuck") {
  const std::string arm = R"yaml(
nodes:
  arm: {position: [0, 0, 0], angular_velocity: [0, 0, 100]}
  b: {position: [1, 0, 0], velocity: [0, 100, 0], angular_velocity: [0, 0, 100]}
elements:
  a: {type: rigid_body, node: arm, mass: 2, inertia: [10, 10, 10]}
  b: {type: rigid_body, node: b, mass: 0.1, inertia: [0.001, 0.001, 0.001]}
joints:
  h: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 0, 1]}
  slide: {type: prismatic, nodes: [arm, b], position: [1, 0, 0], axis: [0, 1, 1], friction: {model: stick_slip, coefficient: 0.9}}
)yaml";
  move(arm, 1e-3, 0.5, [](const Session& session) {
    CHECK_THAT(read(session, "coordinate"), WithinAbs(0, 1e-12));
    CHECK(read(session, "sticks") == 1);
  });
}

TEST_CASE("friction takes no part in statics, and a motion after it begins anew") {
  const std::string text =
      "gravity: [0, 0, -9.81]\n"
      "nodes: {block: {position: [0, 0, 0]}}\n"
      "elements: {block: {type: rigid_body, node: block, mass: 2, inertia: [0.1, 0.1, 0.1]}}\n"
      "joints: {slide: {type: prismatic, nodes: [ground, block], axis: [1, 0, -2], stiffness: 100, friction: {model: "
      "stick_slip, coefficient: 0.01}}}\n";
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  compute_statics(session);
  const double sag = m * g * 2 / std::sqrt(5) / 100;
  CHECK_THAT(read(session, "coordinate"), WithinRel(sag, 1e-9));
  CHECK(read(session, "friction") == 0);
  bielle::mechanism::DynamicsOptions options;
  options.duration = 0.1;
  options.stepping.size = 0.01;
  session.dynamics(options).finish();
  CHECK_THAT(read(session, "coordinate"), WithinRel(sag, 1e-9));
  CHECK(read(session, "sticks") == 1);
}

TEST_CASE("a joint that starts with a rate slips, and one that a drive takes along sticks") {
  move_to(block(", start_rate: 1"), 1e-2, 0.3,
          [](const Session& session) { CHECK_THAT(read(session, "rate"), WithinRel(1 - mu * g * 0.3, 1e-9)); });
  // The file gives no velocities: the drive sets that of the belt, and the block stays behind.
  const std::string belt = R"yaml(
gravity: [0, 0, -9.81]
nodes: {belt: {position: [0, 0, 0]}, block: {position: [0, 0, 0]}}
elements: {block: {type: rigid_body, node: block, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints:
  rail: {type: prismatic, nodes: [ground, belt], axis: [1, 0, 0]}
  slide: {type: prismatic, nodes: [belt, block], axis: [1, 0, 0], friction: {model: stick_slip, coefficient: 0.2}}
drives: {belt: {joint: rail, speed: 1}}
)yaml";
  move(belt, 1e-2, 0.4, [](const Session& session) {
    CHECK_THAT(session.node("block").v.x(), WithinAbs(mu * g * session.time(), 1e-9));
  });
}

TEST_CASE("nothing presses: joints that slide without a normal force are no paradox") {
  for (const char* model :
       {"model: stick_slip", "velocity: 1e-3", "model: lugre, bristle_stiffness: 1e3, bristle_damping: 1"}) {
    CAPTURE(model);
    const std::string text = fmt::format(
        "nodes: {{block: {{position: [0, 0, 0]}}}}\n"
        "elements: {{block: {{type: rigid_body, node: block, mass: 2, inertia: [0.1, 0.1, 0.1]}}}}\n"
        "joints: {{slide: {{type: prismatic, nodes: [ground, block], axis: [1, 2, 3], friction: {{coefficient: 0.2, "
        "{}}}}}}}\n"
        "loads: {{push: {{node: block, force: [1, 2, 3]}}}}\n",
        model);
    move_to(text, 1e-2, 1, [](const Session& session) {
      CHECK_THAT(read(session, "coordinate"), WithinRel(std::sqrt(14.0) / 2 / m, 1e-9));
    });
  }
}

}  // namespace test_sticking_with_others
