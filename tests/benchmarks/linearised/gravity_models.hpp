// Rotors that gravity or unbalance shakes (tests/references/turning_orbits.py).
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "tests/benchmarks/linearised/modes_of.hpp"

namespace bielle::test {

struct Hub {
  double mass, ky, kz, cy, cz;
};

/// Returns blades of 2 kg with lag hinges in a vertical plane. @param first  mass of the first blade relative to the
/// others
/// @param hinge  distance of the hinges from the axis [m]
inline std::string blades(int count, double spring, const std::optional<Hub>& hub, const std::string& drive = "rate: 6",
                          double damping = 0.3, double first = 1, double hinge = 0.2) {
  constexpr double mass = 2, arm = 0.4, own = 0.06;
  std::string nodes, bodies, hinges;
  for (int b = 0; b < count; ++b) {
    const double at = two_pi * b / count, c = std::cos(at), s = std::sin(at);
    nodes += fmt::format("  b{}: {{position: [0, {:.17g}, {:.17g}], rotation_vector: [{:.17g}, 0, 0]}}\n", b,
                         (hinge + arm) * c, (hinge + arm) * s, at);
    const double size = b == 0 ? first : 1;
    bodies += fmt::format("  b{0}: {{type: rigid_body, node: b{0}, mass: {1}, inertia: [{2}, 0, {2}]}}\n", b,
                          size * mass, size * own);
    hinges += fmt::format(
        "  l{0}: {{type: hinge, nodes: [rotor, b{0}], position: [0, {1:.17g}, {2:.17g}], axis: [1, 0, 0], stiffness: "
        "{3}, damping: {4}}}\n",
        b, hinge * c, hinge * s, spring, damping);
  }
  std::string text = "gravity: [0, 0, -9.81]\nnodes:\n  rotor: {}\n" + nodes;
  if (hub) text += "  hub: {fixed: [x, rx, ry, rz]}\n";
  text += "elements:\n  rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [1, 1, 1]}\n" + bodies;
  if (hub) text += fmt::format("  hub: {{type: rigid_body, node: hub, mass: {}, inertia: [1, 1, 1]}}\n", hub->mass - 1);
  text += fmt::format("joints:\n  shaft: {{type: hinge, nodes: [{}, rotor], position: [0, 0, 0], axis: [1, 0, 0]}}\n",
                      hub ? "hub" : "ground");
  if (hub)
    text += fmt::format(
        "  mount: {{type: bushing, nodes: [ground, hub], stiffness: [0, {}, {}, 0, 0, 0], damping: [0, {}, {}, 0, 0, "
        "0]}}\n",
        hub->ky, hub->kz, hub->cy, hub->cz);
  text += hinges;
  if (!drive.empty()) text += "drives: {motor: {joint: shaft, " + drive + "}}\n";
  return text;
}

inline constexpr Hub springs{20, 9000, 14000, 30, 50};

/// Returns a mass of 1 kg at 0.5 m on a rotor that turns freely in a hub on springs.
inline std::string unbalanced(const std::string& damping = "", const std::string& drive = "") {
  std::string text =
      "nodes: {hub: {fixed: [z, rx, ry, rz]}, rotor: {}, p: {position: [0.5, 0, 0]}}\n"
      "elements:\n  hub: {type: rigid_body, node: hub, mass: 9, inertia: [1, 1, 1]}\n"
      "  rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [0.3, 0.3, 0.3]}\n"
      "  p: {type: point_mass, node: p, mass: 1}\n"
      "joints:\n  mount: {type: bushing, nodes: [ground, hub], stiffness: [1000, 1500, 0, 0, 0, 0]" +
      damping +
      "}\n  shaft: {type: hinge, nodes: [hub, rotor], position: [0, 0, 0], axis: [0, 0, 1]}\n"
      "  arm: {type: rigid, nodes: [rotor, p]}\n";
  if (!drive.empty()) text += "drives: {motor: {joint: shaft, " + drive + "}}\n";
  return text;
}

}  // namespace bielle::test
