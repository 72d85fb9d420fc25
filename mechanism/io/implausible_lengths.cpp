#include "mechanism/io/implausible_lengths.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "mechanism/elements/rigid_body/rigid_body.hpp"
#include "mechanism/joints/joint.hpp"

namespace bielle::mechanism {
namespace {

/// Links of machines are shorter than this in metres, and longer in millimetres [m].
constexpr double longest_usual = 10;
/// Smallest usual ratio of the radius of gyration to the distance of joints. A bar has a ratio of 0.29, and a
/// thousandth of this if units are mixed up.
constexpr double least_usual = 1.0 / 300;

/// Returns the points at which joints act on each node, in the inertial frame at the start.
std::map<int, std::vector<Vector3>> attachments(const Model& model) {
  std::map<int, std::vector<Vector3>> points;
  for (const Member& member : model.members()) {
    const auto* joint = dynamic_cast<const Joint*>(member.component.get());
    if (joint == nullptr) continue;
    const JointFrames& frames = joint->frames();
    for (const auto& [node, on_node] : {std::pair{frames.first, frames.on_first}, {frames.second, frames.on_second}})
      points[model.root_carrier(node)].push_back((model.node(node).frame * on_node).x);
  }
  return points;
}

double largest_distance(const std::vector<Vector3>& points) {
  constexpr std::size_t most = 20;  // this number of joints is sufficient also for bodies with more
  double largest = 0;
  for (std::size_t i = 0; i < std::min(points.size(), most); ++i)
    for (std::size_t j = 0; j < i; ++j) largest = std::max(largest, (points[i] - points[j]).norm());
  return largest;
}

}  // namespace

void warn_of_lengths(const Model& model, const YamlValue& root) {
  const std::map<int, std::vector<Vector3>> points = attachments(model);
  std::string first;
  double distance = 0, gyration = 0;
  for (const Member& member : model.members()) {
    const auto* body = dynamic_cast<const RigidBody*>(member.component.get());
    if (body == nullptr) continue;
    const auto found = points.find(model.root_carrier(body->node()));
    const double trace = body->properties().inertia.trace();
    if (found == points.end() || !(trace > 0)) continue;
    const double between = largest_distance(found->second), radius = std::sqrt(0.5 * trace / body->properties().mass);
    if (between == 0) continue;
    if (between < longest_usual || radius > least_usual * between) return;
    if (first.empty()) first = member.entry.name, distance = between, gyration = radius;
  }
  if (first.empty()) return;
  const std::string warning = fmt::format(
      "its joints are {:.3g} m apart, and its inertia is that of a body of {:.2g} m: is that meant? "
      "Positions are in metres, inertias in kg m^2",
      distance, 3.5 * gyration);
  root.at("elements").at(first).warn(warning);
}

}  // namespace bielle::mechanism
