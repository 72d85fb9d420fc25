#include "mechanism/joints/joint_frames.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "mechanism/joints/joint_place.hpp"
#include "mechanism/math/axes_along.hpp"
#include "mechanism/reading/names.hpp"

namespace bielle::mechanism {
namespace {

/// Vectors on the two nodes, in initial inertial components.
using OnNodes = std::array<Vector3, 2>;

bool is_pair_of_vectors(const YamlValue& value) {
  return value.is_sequence() && value.size() > 0 && value.at(std::size_t{0}).is_sequence();
}

/// Reads a direction, or one in the axes of each node.
OnNodes read_directions(const YamlValue& value, const Frame& first, const Frame& second) {
  if (!is_pair_of_vectors(value)) {
    const Vector3 direction = value.direction();
    return {direction, direction};
  }
  if (value.size() != 2)
    value.fail("expected a direction [x, y, z], or a pair [[x, y, z], [x, y, z]] of one in the axes of each node");
  return {first.R * value.at(std::size_t{0}).direction(), second.R * value.at(std::size_t{1}).direction()};
}

/// Returns the part of x normal to z. @throws InputError if there is none
Vector3 normal_part(const Vector3& x, const Vector3& z, const YamlValue& given) {
  const Vector3 normal = x - z * z.dot(x);
  if (normal.norm() < 1e-6) given.fail("is parallel to the joint's axis");
  return normal;
}

/// Returns x rotated by the smallest rotation from z to `to`; if they are opposite, rotated about x.
Vector3 turned_along(const Vector3& x, const Vector3& z, const Vector3& to) {
  const double cosine = z.dot(to);
  if (cosine < -1 + 1e-12) return x;
  const Vector3 w = z.cross(to);
  return x + w.cross(x) + w.cross(w.cross(x)) / (1 + cosine);
}

Matrix3 axes_of(const Vector3& x_direction, const Vector3& z) {
  const Vector3 x = x_direction.normalized();
  Matrix3 R;
  R << x, z.cross(x), z;
  return R;
}

/// Reads the axes of the joint's frame on each node, in initial inertial components.
std::array<Matrix3, 2> read_axes(const YamlValue& entry, const Frame& first, const Frame& second, AxisNeed need,
                                 const std::string& axis_key) {
  const std::optional<YamlValue> second_axis = entry.find("second_axis");
  if (need == AxisNeed::optional && !entry.has(axis_key) && !second_axis)
    return {Matrix3::Identity(), Matrix3::Identity()};
  const OnNodes z = need == AxisNeed::required || entry.has(axis_key)
                        ? read_directions(entry.at(axis_key), first, second)
                        : OnNodes{Vector3::UnitZ(), Vector3::UnitZ()};
  OnNodes x;
  if (second_axis) {
    const OnNodes given = read_directions(*second_axis, first, second);
    for (std::size_t k = 0; k < 2; ++k) x[k] = normal_part(given[k], z[k], *second_axis);
  } else {
    const Vector3 along = most_normal_axis(z[0]);
    x[0] = along - z[0] * z[0].dot(along);
    x[1] = z[0] == z[1] ? x[0] : turned_along(x[0], z[0], z[1]);
  }
  return {axes_of(x[0], z[0]), axes_of(x[1], z[1])};
}

}  // namespace

Vector3 smallest_turn(const Vector3& from, const Vector3& to, const Vector3& normal) {
  const Vector3 product = from.cross(to);
  const double sine = product.norm(), angle = std::atan2(sine, from.dot(to));
  return angle * (sine > 1e-12 ? Vector3(product / sine) : normal);
}

std::vector<Key> joint_place_keys() {
  using namespace keys;
  return {type_key(),
          {"nodes", list_of(2, name_of("node")), required, "First and second node."},
          {"position", vector3("m").as_point().in_inertial_axes(), computed("the position of the second node"),
           "Place of the joint as drawn, fixed on both nodes."},
          {"at", list_of(2, vector3("m").as_point()), optional,
           "Points in the axes of the first and of the second node, in place of `position`; the start brings the two "
           "together, in the directions that the joint constrains."}};
}

std::vector<Key> joint_frame_keys(AxisNeed need, const std::string& axis_key, AxisUse use) {
  using namespace keys;
  const KeyForm z = use == AxisUse::turning ? direction().as_axial() : direction().as_vector();
  const KeyForm x = direction().as_vector();
  const Presence presence = need == AxisNeed::required ? required : computed("the inertial z axis");
  return joined({joint_place_keys(),
                 {{axis_key,
                   {z.in_inertial_axes(), list_of(2, z)},
                   presence,
                   "Direction of z of the joint's frame as drawn, fixed on both nodes; or one in the axes of each "
                   "node, which the start makes fit if the joint constrains them."},
                  {"second_axis",
                   {x.in_inertial_axes(), list_of(2, x)},
                   computed("the inertial axis most normal to z, as drawn"),
                   "Direction of x of the joint's frame, which is made orthogonal to z; or one in the axes of each "
                   "node, which the start makes fit if the joint constrains them."}}});
}

std::array<Vector3, 2> read_points_at(const YamlValue& at) {
  if (!at.is_sequence() || at.size() != 2 || !is_pair_of_vectors(at))
    at.fail("expected [[x, y, z], [x, y, z]]: the joint's point in the axes of the first node and of the second");
  return {at.at(std::size_t{0}).vector3(), at.at(std::size_t{1}).vector3()};
}

JointFrames read_joint_place(const YamlValue& entry, const Model& model) {
  constexpr int ground = 0;  // index of the built-in node
  JointFrames frames;
  const std::vector<int> nodes = nodes_named_by(entry.at("nodes"), 2, model);
  frames.first = nodes[0];
  frames.second = nodes[1];
  if (frames.first == frames.second) entry.at("nodes").fail("a joint needs two different nodes");
  const Frame &first = model.node(nodes[0]).frame, &second = model.node(nodes[1]).frame;
  const std::optional<YamlValue> position = entry.find("position"), at = entry.find("at");
  if (position && at)
    at->fail(
        "a joint is attached at a `position` as drawn, or `at` a point in the axes of each node: give one of them");
  const Vector3 place = position ? position->vector3() : second.x;
  frames.on_first = inverse(first) * Frame{place, Matrix3::Identity()};
  frames.on_second = inverse(second) * Frame{place, Matrix3::Identity()};
  if (at) {
    const auto points = read_points_at(*at);
    frames.on_first.x = points[0];
    frames.on_second.x = points[1];
  } else if (!position && frames.first != ground) {
    // A joint between a part and the ground is at the part, because the origin of the ground is not a point of the
    // machine.
    constexpr double rounding = 1e-9;  // [m]
    const double distance = (second.x - first.x).norm();
    if (distance > rounding) frames.arm = distance;
  }
  return frames;
}

JointFrames read_joint_frames(const YamlValue& entry, const Model& model, AxisNeed need, const std::string& axis_key) {
  JointFrames frames = read_joint_place(entry, model);
  const Frame &first = model.node(frames.first).frame, &second = model.node(frames.second).frame;
  const std::array<Matrix3, 2> axes = read_axes(entry, first, second, need, axis_key);
  frames.on_first.R = first.R.transpose() * axes[0];
  frames.on_second.R = second.R.transpose() * axes[1];
  return frames;
}

}  // namespace bielle::mechanism
