#include "mechanism/solvers/start/start_report.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mechanism/model/start_coordinates.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/start_conditions.hpp"

namespace bielle::mechanism {

void StartReport::add(const StartReport& later) {
  if (later.largest_displacement > largest_displacement) {
    largest_displacement = later.largest_displacement;
    displaced_node = later.displaced_node;
  }
  largest_rotation = std::max(largest_rotation, later.largest_rotation);
  velocity_change = std::max(velocity_change, later.velocity_change);
  angular_change = std::max(angular_change, later.angular_change);
  if (later.settled > settled) {
    settled = later.settled;
    settled_node = later.settled_node;
  }
  if (later.unstable > 0) {
    unstable = later.unstable;
    unstable_motion = later.unstable_motion;
  }
  if (!later.loose.empty()) loose = later.loose;
  if (later.balanced > balanced) {
    balanced = later.balanced;
    balanced_node = later.balanced_node;
  }
  if (!later.held.empty()) held = later.held;
  if (!later.unbalanced.empty()) unbalanced = later.unbalanced;
  moved_nodes.insert(moved_nodes.end(), later.moved_nodes.begin(), later.moved_nodes.end());
  moved_coordinates.insert(moved_coordinates.end(), later.moved_coordinates.begin(), later.moved_coordinates.end());
  following.insert(following.end(), later.following.begin(), later.following.end());
  carried.insert(carried.end(), later.carried.begin(), later.carried.end());
}

void StartReport::note_change(const System& system, const VectorX& before, const VectorX& change) {
  for (int i = 0; i < system.dofs(); ++i) {
    const double size = std::abs(change[i]);
    if (system.kind(i) == Kind::translation) velocity_change = std::max(velocity_change, size);
    if (system.kind(i) == Kind::rotation && before[i] != 0) angular_change = std::max(angular_change, size);
  }
}

void note_farthest(const System& system, const State& from, const State& to, double& distance, std::string& node) {
  for (std::size_t i = 0; i < to.nodes.size(); ++i) {
    const double moved = (to.nodes[i].x - from.nodes[i].x).norm();
    if (moved <= distance) continue;
    distance = moved;
    node = system.model().node(static_cast<int>(i)).name;
  }
}

namespace {

constexpr double unmoved = 1e-9;  // [m], [rad]

/// Sorts by size, the largest first, and appends.
template <class Moved>
void append_by_size(std::vector<std::pair<double, Moved>>& found, std::vector<Moved>& list) {
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (auto& [size, moved] : found) list.push_back(std::move(moved));
}

}  // namespace

void note_moved(const System& system, const Environment& environment, const State& from, const State& to,
                StartReport& report) {
  note_farthest(system, from, to, report.largest_displacement, report.displaced_node);
  const double length = 0.5 * model_extent(from);  // length by which a rotation is converted to a displacement
  std::vector<std::pair<double, MovedNode>> nodes;
  for (std::size_t i = 0; i < to.nodes.size(); ++i) {
    const double rotation = log_so3(Matrix3(from.nodes[i].R.transpose() * to.nodes[i].R)).norm();
    report.largest_rotation = std::max(report.largest_rotation, rotation);
    const double displacement = (to.nodes[i].x - from.nodes[i].x).norm();
    const Node& node = system.model().node(static_cast<int>(i));
    if (node.internal || (displacement <= unmoved && rotation <= unmoved)) continue;
    nodes.emplace_back(std::max(displacement, length * rotation), MovedNode{node.name, displacement, rotation});
  }
  append_by_size(nodes, report.moved_nodes);

  std::vector<std::pair<double, MovedCoordinate>> coordinates;
  for (std::size_t m = 0; m < system.slots().size(); ++m) {
    const std::vector<StartCoordinate> all = start_coordinates_of(*system.model().members()[m].component);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double before = coordinate_row(system, environment, from, m, k).value,
                   change = coordinate_distance(all[k], coordinate_row(system, environment, to, m, k).value, before);
      if (std::abs(change) <= unmoved) continue;
      coordinates.emplace_back(
          std::abs(change) * (all[k].units == "m" ? 1 : length),
          MovedCoordinate{coordinate_name(system, m, all[k]), all[k].units, before, before + change});
    }
  }
  append_by_size(coordinates, report.moved_coordinates);
}

}  // namespace bielle::mechanism
