// A self-locking screw, and a chain that is pulled over guides like a rope over a drum.
#include <cmath>

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"

using bielle::mechanism::Session;
using bielle::test::move;
using bielle::test::move_to;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace test_thread_and_chain {
namespace {

constexpr double m = 2, J = 1e-3, g = 9.81, r = 0.01;

std::string nut(double mu, double pitch, const std::string& model) {
  return fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes: {{nut: {{position: [0, 0, 0]}}}}
elements: {{nut: {{type: rigid_body, node: nut, mass: 2, inertia: [1e-3, 1e-3, 1e-3]}}}}
joints: {{screw: {{type: screw, nodes: [ground, nut], axis: [0, 0, 1], pitch: {:.17g},
                 friction: {{coefficient: {:.17g}, radius: 0.01, {}}}}}}}
)yaml",
                     pitch, mu, model);
}

}  // namespace

TEST_CASE("a screw locks itself where the slope of its thread is below the coefficient of friction") {
  for (const double pitch : {0.02, -0.02}) {  // right- and left-handed
    const double l = pitch / (2 * M_PI), slope = std::abs(l) / r, c = std::hypot(r, l);
    move_to(nut(1.001 * slope, pitch, "model: stick_slip"), 0.01, 1, [](const Session& session) {
      CHECK_THAT(session.read("joints/screw/coordinate")[1], WithinAbs(0, 1e-12));
      CHECK(session.read("joints/screw/sticks")[0] == 1);
    });
    // The screw slides down. Along the axis: m l th'' = -m g + (N r + mu N |l|)/c; about it: J th'' = -(l N r - sign(l)
    // mu N r^2)/c.
    for (const double share : {0.999, 0.5}) {
      const double mu = share * slope, sign = pitch > 0 ? 1 : -1;
      Eigen::Matrix2d A;
      A << m * l, -(r + mu * std::abs(l)) / c, J, (l * r - sign * mu * r * r) / c;
      const Eigen::Vector2d expected = A.partialPivLu().solve(Eigen::Vector2d(-m * g, 0));
      CAPTURE(pitch, share);
      move_to(nut(mu, pitch, "model: stick_slip"), 0.01, 1, [&](const Session& session) {
        CHECK_THAT(session.read("joints/screw/coordinate")[1], WithinRel(0.5 * expected[0], 1e-8));
        CHECK_THAT(session.read("joints/screw/normal_force")[0], WithinRel(expected[1], 1e-8));
        CHECK_THAT(session.balance(), WithinAbs(0, 1e-9));
      });
    }
  }
}

// n blocks stand on a circle, an angle delta apart, each on a guide along its tangent, and rods join neighbours. Pulled
// slowly at one end against a force at the other, a rod at delta/2 from either tangent carries T_i:
//     (T_i - T_(i-1)) cos(delta/2) = mu N_i,   N_i = (T_i + T_(i-1)) sin(delta/2),
//     T_i/T_(i-1) = (1 + mu tan(delta/2))/(1 - mu tan(delta/2)),
// which tends to Euler's and Eytelwein's exp(mu delta).
TEST_CASE("a chain pulled over guides needs the force of the capstan") {
  constexpr int n = 12;
  constexpr double mu = 0.3, delta = M_PI / 2 / (n - 1), held = 5, speed = 1e-3;
  std::string nodes, elements, joints;
  for (int i = 0; i < n; ++i) {
    const double a = i * delta, c = std::cos(a), s = std::sin(a);
    nodes += fmt::format("  n{0}: {{position: [{1:.17g}, {2:.17g}, 0], velocity: [{3:.17g}, {4:.17g}, 0]}}\n", i, c, s,
                         -speed * s, speed * c);
    elements += fmt::format("  n{0}: {{type: rigid_body, node: n{0}, mass: 1e-3, inertia: [1e-6, 1e-6, 1e-6]}}\n", i);
    joints += fmt::format(
        "  g{0}: {{type: prismatic, nodes: [ground, n{0}], axis: [{1:.17g}, {2:.17g}, 0], friction: {{coefficient: "
        "0.3, velocity: 1e-5}}}}\n",
        i, -s, c);
    if (i > 0) joints += fmt::format("  r{0}: {{type: distance, nodes: [n{1}, n{0}]}}\n", i, i - 1);
  }
  const std::string text = "nodes:\n" + nodes + "elements:\n" + elements + "joints:\n" + joints +
                           fmt::format("loads: {{back: {{node: n0, force: [0, {:.17g}, 0]}}}}\n", -held) +
                           fmt::format("drives: {{pull: {{joint: g{}, speed: {:.17g}}}}}\n", n - 1, speed);
  bool first = true;
  move(
      text, 1e-3, 1e-3,
      [&](const Session& session) {
        if (!first) return;
        first = false;
        // The first block has the given force along its guide, and one rod: T cos = held + mu T sin.
        const double h = delta / 2, ratio = (1 + mu * std::tan(h)) / (1 - mu * std::tan(h));
        double T = held / (std::cos(h) - mu * std::sin(h));
        for (int i = 1; i < n; ++i) {
          CAPTURE(i);
          // Inertia is negligible: m v^2 is 1e-9 of the forces.
          CHECK_THAT(session.read(fmt::format("joints/g{}/normal_force", i))[0],
                     WithinRel(i < n - 1 ? T * (1 + ratio) * std::sin(h) : T * std::sin(h), 1e-6));
          if (i < n - 1) T *= ratio;
        }
        const double pulled = T * (std::cos(h) + mu * std::sin(h));
        CHECK_THAT(session.read(fmt::format("joints/g{}/drive_force", n - 1))[0], WithinRel(pulled, 1e-6));
        CHECK_THAT(std::log(pulled / held), WithinRel(mu * M_PI / 2, 2e-2));  // a polygon of 12 for the arc
      },
      true);
  CHECK(!first);
}

}  // namespace test_thread_and_chain
