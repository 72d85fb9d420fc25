// Rotations without inertia on which nothing acts: models that hold them by other means, or that have inertia there,
// move in the same way.
#include <algorithm>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/messages.hpp"
#include "tests/support/session_model.hpp"

using bielle::ComputationError;
using bielle::mechanism::Session;
using bielle::test::message_of;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;

namespace test_idle_rotations {
namespace {

/// Returns a net of two masses on springs, cables and rods, which swings in all directions. @param hold  keys of both
/// nodes
std::string net(const std::string& hold, const std::string& more = "") {
  return fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes:
  a: {{position: [1, 0, 0], velocity: [0, 2, 0]{0}}}
  b: {{position: [1, 0, -1]{0}}}
elements:
  a: {{type: point_mass, node: a, mass: 1}}
  b: {{type: point_mass, node: b, mass: 0.5}}
  spring: {{type: spring_damper, nodes: [a, b], stiffness: 200, damping: 0.5}}
joints:
  rod: {{type: distance, nodes: [ground, a]}}
  sling: {{type: cable, nodes: [ground, b], radii: [0, 0], EA: 300, pretension: 5}}
loads:
  wind: {{node: b, force: ["2*sin(5*t)", 1, 0]}}
{1})yaml",
                     hold, more);
}

/// Returns a four-bar in space: its coupler has spherical joints at both ends. @param inertia  about its line
std::string four_bar(double inertia) {
  return fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes:
  crank: {{position: [0, 0, 0.2]}}
  coupler: {{position: [0.5, 0.15, 0.45]}}
  rocker: {{position: [1, 0.3, 0.25]}}
elements:
  crank: {{type: rigid_body, node: crank, mass: 1, inertia: [0.02, 0.02, 0.02]}}
  coupler: {{type: rigid_body, node: coupler, mass: 1, inertia: [{}, 0.1, 0.1], inertia_axes: {{axes: {{x: [1, 0.3, 0.1], y: [-0.3, 1, 0]}}}}}}
  rocker: {{type: rigid_body, node: rocker, mass: 1, inertia: [0.05, 0.05, 0.05]}}
joints:
  crank: {{type: hinge, nodes: [ground, crank], position: [0, 0, 0], axis: [0, 1, 0]}}
  pin: {{type: spherical, nodes: [crank, coupler], position: [0, 0, 0.4]}}
  ball: {{type: spherical, nodes: [coupler, rocker], position: [1, 0.3, 0.5]}}
  rocker: {{type: hinge, nodes: [ground, rocker], position: [1, 0.3, 0], axis: [0.2, 1, 0]}}
)yaml",
                     inertia);
}

double largest_gap(const std::string& one, const std::string& other, const std::string& node, double duration) {
  Session first = session_of(one), second = session_of(other);
  auto motion = first.dynamics(steps_of(duration, 2e-3)), twin = second.dynamics(steps_of(duration, 2e-3));
  double gap = 0;
  while (motion.step() && twin.step()) gap = std::max(gap, (first.node(node).x - second.node(node).x).norm());
  return gap;
}

}  // namespace

TEST_CASE("point masses on springs, cables and rods need no holds") {
  CHECK(largest_gap(net(""), net(", fixed: [rx, ry, rz]"), "b", 2) == 0);
}

TEST_CASE("a coupler without inertia about its line moves like one with some") {
  // Moments of inertia about the line have no effect: no moment acts about it, and the body does not spin at the start.
  CHECK(largest_gap(four_bar(0), four_bar(1e-3), "rocker", 1) < 1e-9);
  CHECK(largest_gap(four_bar(0), four_bar(1e-3), "coupler", 1) < 1e-9);
}

TEST_CASE("a rotation on which something may act is still refused") {
  const auto said = [](const std::string& more) {
    return message_of<ComputationError>([&] { session_of(net("", more)).dynamics(steps_of(0.1, 0.01)); });
  };
  CHECK_THAT(said("  twist: {node: b, moment: [0, \"sin(t)\", 0]}\n"), Contains("node 'b'") && Contains("no mass"));
  CHECK_THAT(message_of<ComputationError>([] {
               session_of(
                   "nodes: {wheel: {}}\n"
                   "elements: {wheel: {type: point_mass, node: wheel, mass: 1}}\n"
                   "joints: {axle: {type: hinge, nodes: [ground, wheel], axis: [0, 0, 1]}}\n")
                   .dynamics(steps_of(0.1, 0.01));
             }),
             Contains("rotation z of node 'wheel'") && Contains("no mass"));
}

}  // namespace test_idle_rotations
