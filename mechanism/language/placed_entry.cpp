#include "mechanism/language/placed_entry.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "mechanism/math/axes_along.hpp"

namespace bielle::mechanism {
namespace {

using Geometry = KeyForm::Geometry;

bool turns(const Placement& placement) { return placement.mirrored >= 0 || !placement.frame.R.isIdentity(0); }

/// Types whose mirror images have the same keys, with placed vectors. All others are refused.
const std::vector<std::string> mirrored_elements = {"rigid_body",    "point_mass", "beam",
                                                    "spring_damper", "node_force", "hydraulic_actuator"};
const std::vector<std::string> mirrored_joints = {"rigid",
                                                  "hinge",
                                                  "prismatic",
                                                  "spherical",
                                                  "planar",
                                                  "universal",
                                                  "distance",
                                                  "spherical_spherical",
                                                  "revolute_spherical",
                                                  "point_on_line",
                                                  "point_on_plane",
                                                  "clearance_hinge",
                                                  "clearance_spherical",
                                                  "gear",
                                                  "differential",
                                                  "rack_and_pinion",
                                                  "contact"};

/// Returns the reason why an entry cannot be mirrored; empty if it can be.
std::string fault_of_mirror(const YamlNode& entry, const std::string& section) {
  const Tree type = find_value(entry, "type");
  const std::string name = type ? type->scalar : "";
  if (section == "elements" && !is_among(name, mirrored_elements)) return fmt::format("a {} has no mirror image", name);
  if (section == "joints" && !is_among(name, mirrored_joints))
    return fmt::format("a {} joint has no mirror image with the same signs", name);
  if (name == "beam") {
    const Tree cross_section = find_value(entry, "section");
    const auto is_one_sided = [](const YamlNode& shape) {
      for (const char* key : {"l", "stiffness", "mass", "offset", "stress_points"})
        if (find_pair(shape, key)) return true;
      return false;
    };
    bool one_sided = cross_section && is_one_sided(*cross_section);
    if (cross_section)
      for (const Tree& end : cross_section->items) one_sided = one_sided || is_one_sided(*end);
    if (one_sided) return "a beam is mirrored if its section is symmetric, without offset, stress points or matrices";
    if (find_pair(entry, "distributed")) return "a beam with distributed loads has no mirror image";
  }
  if (name == "spherical")
    for (const char* key : {"rest", "preload", "stops", "locked", "start", "start_rate"})
      if (find_pair(entry, key)) return "the coordinates of a spherical joint change their signs in a mirror";
  if (name == "contact")
    for (const char* list : {"shapes", "between"})
      if (const Tree shapes = find_value(entry, list))
        for (const Tree& shape : shapes->items)
          if (find_pair(*shape, "surface")) return "a surface from a file has no mirror image";
  return {};
}

/// Returns whether the directions held by a node are the same after the axes are turned. A reflection never changes
/// them.
bool are_same_when_placed(const YamlNode& fixed, const Placement& placement) {
  if (placement.frame.R.isIdentity(0) || fixed.kind != YamlNode::Kind::sequence) return true;
  int translations = 0, rotations = 0;
  for (const Tree& item : fixed.items) ++(item->scalar.starts_with('r') ? rotations : translations);
  return (translations == 0 || translations == 3) && (rotations == 0 || rotations == 3);
}

/// Returns whether a prescribed motion is unchanged by a reflection: a displacement along the mirror, or a rotation
/// about its normal.
bool is_same_when_placed(const YamlNode& motion, const Placement& placement) {
  if (!placement.frame.R.isIdentity(0)) return false;
  const char normal = static_cast<char>('x' + placement.mirrored);
  return std::all_of(motion.pairs.begin(), motion.pairs.end(), [&](const YamlNode::Pair& pair) {
    const std::string& direction = pair.key->scalar;
    return direction.starts_with('r') ? direction.ends_with(normal) : !direction.ends_with(normal);
  });
}

Tree make_vector(const Vector3& v, const YamlNode& place) { return make_numbers({v[0], v[1], v[2]}, place); }

/// Reads three numbers of an entry in the model. Returns no value if the entry has another form.
std::optional<Vector3> read_vector(const YamlNode& list, const Scope& scope, const std::string& path) {
  if (list.kind != YamlNode::Kind::sequence || list.items.size() != 3) return {};
  Vector3 v;
  for (int k = 0; k < 3; ++k) {
    const YamlNode& item = *list.items[static_cast<std::size_t>(k)];
    if (item.kind != YamlNode::Kind::scalar) return {};
    v[k] = scope.number(item, path);
  }
  return v;
}

Tree with_joint_axes(const Tree& placed, const std::string& axis_key, const KeyForm& axis, const Scope& scope,
                     const NodeFrame& node_frame, const std::string& path) {
  const Matrix3 of_axis = scope.placement.matrix(axis.geometry, true);
  const Matrix3 of_second = scope.placement.matrix(Geometry::vector, true);
  const auto with_second = [&](const Tree& entry, const Vector3& x) {
    return with(*entry, "second_axis", make_vector(of_second * x, *placed));
  };
  const Tree given = find_value(*placed, axis_key);
  if (!given) {
    const Tree complete = with(*placed, axis_key, make_vector(of_axis * Vector3::UnitZ(), *placed));
    return find_pair(*placed, "second_axis") ? complete : with_second(complete, Vector3::UnitX());
  }
  if (find_pair(*placed, "second_axis")) return placed;
  std::optional<Vector3> z = read_vector(*given, scope, path + "." + axis_key);
  const Tree nodes = find_value(*placed, "nodes");
  const bool is_pair = given->kind == YamlNode::Kind::sequence && given->items.size() == 2;
  if (!z && is_pair && nodes && !nodes->items.empty())
    if (const auto own = read_vector(*given->items[0], scope, path + "." + axis_key))
      z = node_frame(*nodes->items[0], path + ".nodes").R * *own;
  if (!z) return placed;  // the reader of the joint reports the error
  return with_second(placed, most_normal_axis((of_axis.transpose() * *z).normalized()));
}

/// Adds x of a joint whose two shafts have axes of their own.
Tree with_second_of_first(const Tree& placed, const YamlNode& axes, const KeyTable& table, const Scope& scope,
                          const std::string& path) {
  if (find_pair(*placed, "second_axis") || axes.items.empty()) return placed;
  const std::optional<Vector3> z = read_vector(*axes.items.front(), scope, path + ".axes");
  if (!z) return placed;  // the reader of the joint reports the error
  const Matrix3 of_axis = scope.placement.matrix(table.find("axis")->forms.front().geometry, true);
  const Vector3 x =
      scope.placement.matrix(Geometry::vector, true) * most_normal_axis((of_axis.transpose() * *z).normalized());
  return with(*placed, "second_axis", make_vector(x, *placed));
}

Tree with_beam_orientation(const Tree& placed, const Scope& scope, const NodeFrame& node_frame,
                           const std::string& path) {
  const Tree nodes = find_value(*placed, "nodes");
  if (find_pair(*placed, "orientation") || !nodes || nodes->items.size() != 2) return placed;
  if (find_pair(*placed, "arc_centre") || find_pair(*placed, "arc_through"))
    fail_at(*placed, *scope.main_file, path, "a beam along an arc needs its `orientation` in a part that is turned");
  const Vector3 along =
      node_frame(*nodes->items[1], path + ".nodes").x - node_frame(*nodes->items[0], path + ".nodes").x;
  const Matrix3 A = scope.placement.matrix(Geometry::vector, true);
  const Vector3 y = most_normal_axis(A.transpose() * along);
  return with(*placed, "orientation", make_vector(scope.placement.matrix(Geometry::axial, true) * y, *placed));
}

}  // namespace

void check_placed(const YamlNode& entry, const std::string& section, const Scope& scope, const std::string& path) {
  if (entry.kind != YamlNode::Kind::map || !turns(scope.placement)) return;
  if (section == "nodes") {
    const Tree fixed = find_value(entry, "fixed");
    const Tree axes = find_value(entry, "fixed_axes");
    const bool turn_along = axes && axes->scalar == "own";
    if (fixed && !turn_along && !are_same_when_placed(*fixed, scope.placement))
      fail_at(
          *fixed, *scope.main_file, path + ".fixed",
          "these directions are inertial axes, and the part is turned or mirrored: hold the node along its own axes "
          "(`fixed_axes: own`), or by a joint to `ground`");
    if (const Tree motion = find_value(entry, "motion"); motion && !is_same_when_placed(*motion, scope.placement))
      fail_at(*motion, *scope.main_file, path + ".motion",
              "a motion is along inertial axes, and the part is turned or mirrored: move the node by a joint and a "
              "drive");
  }
  if (scope.placement.mirrored < 0) return;
  if (const std::string fault = fault_of_mirror(entry, section); !fault.empty())
    fail_at(entry, *scope.main_file, path, fault + ", and the part is mirrored");
}

Tree with_explicit_axes(const Tree& placed, const KeyTable& table, const Scope& scope, const NodeFrame& node_frame,
                        const std::string& path) {
  if (placed->kind != YamlNode::Kind::map) return placed;
  const Tree entry = table.find("curve_origin") && !find_pair(*placed, "curve_origin")
                         ? with(*placed, "curve_origin", make_vector(scope.placement.frame.x, *placed))
                         : placed;
  if (!turns(scope.placement)) return entry;
  const Tree type = find_value(*entry, "type");
  if (type && type->scalar == "beam") return with_beam_orientation(entry, scope, node_frame, path);
  if (!table.find("second_axis")) return entry;
  if (const Tree axes = find_value(*entry, "axes")) return with_second_of_first(entry, *axes, table, scope, path);
  for (const char* key : {"axis", "line", "normal"})
    if (const Key* axis = table.find(key))
      return with_joint_axes(entry, key, axis->forms.front(), scope, node_frame, path);
  return entry;
}

}  // namespace bielle::mechanism
