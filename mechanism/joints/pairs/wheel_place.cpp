#include "mechanism/joints/pairs/wheel_place.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/reading/names.hpp"

namespace bielle::mechanism {

std::vector<Key> wheel_place_keys() {
  using namespace keys;
  return {type_key(),
          {"nodes", list_of(2, name_of("node")), required, "Node of the plane and node of the wheel."},
          {"position", vector3("m").as_point().in_inertial_axes(), computed("the point below the rim as drawn"),
           "Point of the plane as drawn."},
          {"at", list_of(2, vector3("m").as_point()), optional,
           "Point of the plane and middle of the wheel, each in the axes of its node, in place of `position`."},
          {"normal", direction().as_vector().in_inertial_axes(), required,
           "Normal of the plane, towards the wheel, as drawn."},
          {"axis", direction().as_axial().in_inertial_axes(), required, "Axis of the wheel as drawn."},
          {"radius", number("m").positive(), required, "Radius of the wheel."}};
}

JointFrames read_wheel_place(const YamlValue& entry, const Model& model) {
  const std::vector<int> nodes = nodes_named_by(entry.at("nodes"), 2, model);
  if (nodes[0] == nodes[1]) entry.at("nodes").fail("a joint needs two different nodes");
  const Frame &plane_node = model.node(nodes[0]).frame, &hub = model.node(nodes[1]).frame;
  const Vector3 normal = entry.at("normal").direction(), axis = entry.at("axis").direction();
  const double radius = entry.at("radius").number();
  const double s = std::sqrt(std::max(0.0, 1 - std::pow(normal.dot(axis), 2)));
  if (s < flat_wheel) entry.at("axis").fail("the wheel lies flat on the plane: its axis is parallel to `normal`");
  // The point below the wheel's middle: at the distance given by the rim, or in the plane through `position` or the
  // first point of `at`.
  Vector3 middle = hub.x;
  double height = radius * s;
  if (const auto at = entry.find("at")) {
    if (entry.has("position"))
      at->fail("a wheel has a `position` of its plane or points `at` its nodes: give one of them");
    const auto [on_plane, on_hub] = read_points_at(*at);
    middle = hub.x + hub.R * on_hub;
    height = normal.dot(middle - plane_node.x - plane_node.R * on_plane);
  } else if (const auto position = entry.find("position")) {
    height = normal.dot(middle - position->vector3());
  }
  if (!(height > 0))
    entry.at(entry.has("at") ? "at" : "position")
        .fail("the wheel is drawn below the plane: `normal` points to the wheel");
  const auto frame_with = [](const Vector3& origin, const Vector3& z, const Vector3& x) {
    Frame frame;
    frame.x = origin;
    frame.R << x, z.cross(x), z;
    return frame;
  };
  const Vector3 way = axis.cross(normal).normalized();
  JointFrames frames;
  frames.first = nodes[0];
  frames.second = nodes[1];
  frames.on_first = inverse(plane_node) * frame_with(middle - height * normal, normal, way);
  frames.on_second = inverse(hub) * frame_with(middle, axis, way);
  return frames;
}

}  // namespace bielle::mechanism
