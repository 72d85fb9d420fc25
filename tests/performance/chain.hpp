// The chain that is measured: links of 1 m and 1 kg, joined by spherical joints, horizontal along x from the ground.
#pragma once

#include <string>

#include <fmt/format.h>

namespace bielle::performance {

/// Gravity, nodes, elements and joints of a mechanism file.
inline std::string chain(int links) {
  std::string nodes, elements, joints;
  for (int k = 0; k < links; ++k) {
    nodes += fmt::format("  n{}: {{position: [{}, 0, 0]}}\n", k, k + 0.5);
    elements += fmt::format("  e{}: {{type: rigid_body, node: n{}, mass: 1, inertia: [1e-3, 1/12, 1/12]}}\n", k, k);
    joints += fmt::format("  j{}: {{type: spherical, nodes: [{}, n{}], position: [{}, 0, 0]}}\n", k,
                          k == 0 ? "ground" : fmt::format("n{}", k - 1), k, k);
  }
  return "gravity: [0, 0, -9.81]\nnodes:\n" + nodes + "elements:\n" + elements + "joints:\n" + joints;
}

}  // namespace bielle::performance
