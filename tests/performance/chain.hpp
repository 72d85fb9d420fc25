// The chain that is measured: links of 1 m and 1 kg, horizontal along x from the ground, with joints of one type.
#pragma once

#include <string>

#include <fmt/format.h>

namespace bielle::performance {

/// Gravity, nodes, elements and joints of a mechanism file.
/// @param joint  its type, with what it needs beside nodes and position
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

inline const std::string spherical = "spherical", hinge = "hinge, axis: [0, 1, 0]";

}  // namespace bielle::performance
