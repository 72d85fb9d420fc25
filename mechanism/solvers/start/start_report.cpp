#include "mechanism/solvers/start/start_report.hpp"

#include <algorithm>

namespace bielle::mechanism {

void StartReport::add(const StartReport& later) {
  if (later.largest_displacement > largest_displacement) {
    largest_displacement = later.largest_displacement;
    displaced_node = later.displaced_node;
  }
  largest_rotation = std::max(largest_rotation, later.largest_rotation);
  velocity_change = std::max(velocity_change, later.velocity_change);
  if (later.settled > settled) {
    settled = later.settled;
    settled_node = later.settled_node;
  }
  if (later.balanced > balanced) {
    balanced = later.balanced;
    balanced_node = later.balanced_node;
  }
  if (!later.held.empty()) held = later.held;
  if (!later.unbalanced.empty()) unbalanced = later.unbalanced;
}

void note_farthest(const System& system, const State& from, const State& to, double& distance, std::string& node) {
  for (std::size_t i = 0; i < to.nodes.size(); ++i) {
    const double moved = (to.nodes[i].x - from.nodes[i].x).norm();
    if (moved <= distance) continue;
    distance = moved;
    node = system.model().node(static_cast<int>(i)).name;
  }
}

}  // namespace bielle::mechanism
