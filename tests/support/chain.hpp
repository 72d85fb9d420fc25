// Chains that are measured: links of 1 m and 1 kg, horizontal along x from the ground, with joints of one type.
#pragma once

#include <string>

#include <fmt/format.h>

namespace bielle::test {

inline const std::string spherical = "spherical", hinge = "hinge, axis: [0, 1, 0]";

/// Gravity, nodes, elements and joints of a mechanism file.
/// @param joint  its type, and keys other than nodes and position
inline std::string chain(int links, const std::string& joint) {
  std::string nodes, elements, joints;
  for (int k = 0; k < links; ++k) {
    nodes += fmt::format("  n{}: {{position: [{}, 0, 0]}}\n", k, k + 0.5);
    elements += fmt::format("  e{}: {{type: rigid_body, node: n{}, mass: 1, inertia: [1e-3, 1/12, 1/12]}}\n", k, k);
    joints += fmt::format("  j{}: {{type: {}, nodes: [{}, n{}], position: [{}, 0, 0]}}\n", k, joint,
                          k == 0 ? "ground" : fmt::format("n{}", k - 1), k, k);
  }
  return "gravity: [0, 0, -9.81]\nnodes:\n" + nodes + "elements:\n" + elements + "joints:\n" + joints;
}

/// Returns a chain of flexible links: each is a steel bar of 1 m and 1 kg, one beam element, joined by hinges.
inline std::string flexible_chain(int links) {
  std::string nodes, elements, joints;
  for (int k = 0; k < links; ++k) {
    nodes += fmt::format("  a{0}: {{position: [{0}, 0, 0]}}\n  b{0}: {{position: [{1}, 0, 0]}}\n", k, k + 1);
    elements += fmt::format(
        "  e{0}: {{type: beam, nodes: [a{0}, b{0}], elements: 1, section: {{circle: 6.39e-3, young: 2.1e11, "
        "poisson: 0.3, density: 7800}}}}\n",
        k);
    joints += fmt::format("  j{}: {{type: {}, nodes: [{}, a{}], position: [{}, 0, 0]}}\n", k, hinge,
                          k == 0 ? "ground" : fmt::format("b{}", k - 1), k, k);
  }
  return "gravity: [0, 0, -9.81]\nnodes:\n" + nodes + "elements:\n" + elements + "joints:\n" + joints;
}

}  // namespace bielle::test
