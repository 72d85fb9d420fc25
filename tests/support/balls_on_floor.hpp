// Many balls that fall to a floor, as the text of a model: apart from each other, or into a bin, on a heap.
#pragma once

#include <string>

#include <fmt/format.h>

namespace bielle::test {

struct BallsOnFloor {
  int along = 10;       ///< along^2 balls of 0.05 m and 0.52 kg
  bool heap = false;    ///< in a bin of five by five, in layers; otherwise side by side, 5 cm apart
  bool group = true;    ///< every ball may touch every other; otherwise the floor alone
  bool contact = true;  ///< otherwise they fall freely
  std::string law = "    stiffness: 1e6\n    damping: 0.5\n    friction: {coefficient: 0.3, velocity: 0.01}\n";

  std::string text() const {
    std::string nodes = "nodes:\n", elements = "elements:\n", shapes;
    for (int k = 0; k < along * along; ++k) {
      const int i = k / along, j = k % along;
      const double shift = 0.01 * ((7 * k) % 11) / 11, layer = 2 * (i / 5) + j / 5;
      const double x = heap ? 0.11 * (i % 5) + shift : 0.15 * i, y = heap ? 0.11 * (j % 5) - shift : 0.15 * j,
                   z = heap ? 0.06 + 0.12 * layer + 1e-3 * k : 0.051 + 5e-4 * k;
      nodes += fmt::format("  b{}: {{position: [{}, {}, {}]}}\n", k, x, y, z);
      elements += fmt::format("  b{0}: {{type: rigid_body, node: b{0}, solid: {{sphere: 0.05, density: 1000}}}}\n", k);
      shapes += fmt::format("        - {{node: b{}, sphere: 0.05}}\n", k);
    }
    std::string walls = "        - {node: ground, plane: [0, 0, 1]}\n";
    if (heap)
      for (const char* wall : {"[1, 0, 0], at: [-0.07, 0, 0]", "[-1, 0, 0], at: [0.52, 0, 0]",
                               "[0, 1, 0], at: [0, -0.07, 0]", "[0, -1, 0], at: [0, 0.52, 0]"})
        walls += fmt::format("        - {{node: ground, plane: {}}}\n", wall);
    std::string joints;
    if (contact)
      joints = "joints:\n  it:\n    type: contact\n" +
               (group ? "    shapes:\n" + walls + shapes : "    between:\n      -\n" + walls + "      -\n" + shapes) +
               law;
    return "gravity: [0, 0, -9.81]\n" + nodes + elements + joints;
  }
};

}  // namespace bielle::test
