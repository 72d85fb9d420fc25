#include "reduce/body_file/body_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "reduce/body_file/body_interfaces.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

namespace {

constexpr int most_pieces = 1000;

/// Gives the plane the name that the user gives, or `cut_<number>`.
void add_plane(const YamlValue& value, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
               std::vector<CutPlane>& cuts) {
  CutPlane plane{fmt::format("cut_{}", cuts.size() + 1), point, normal, value.path()};
  if (value.is_map())
    if (const auto name = value.find("name")) {
      plane.name = name->text();
      check_name(plane.name, *name);
    }
  const auto same = std::find_if(cuts.begin(), cuts.end(), [&](const CutPlane& cut) { return cut.name == plane.name; });
  if (same != cuts.end()) value.fail(fmt::format("there are two cuts '{}'", plane.name));
  cuts.push_back(plane);
}

/// `{axis: x, at: 0.2}`, or at several places: planes normal to an axis of the body.
void add_planes_along_axis(const YamlValue& value, std::vector<CutPlane>& cuts) {
  value.check_keys({"axis", "at", "name"}, "planes normal to an axis");
  static const std::vector<std::string> axes = {"x", "y", "z"};
  const std::string axis = value.at("axis").word(axes, "an axis of the body");
  const Eigen::Vector3d normal = Eigen::Vector3d::Unit(std::find(axes.begin(), axes.end(), axis) - axes.begin());
  const YamlValue at = value.at("at");
  if (!at.is_sequence()) return add_plane(value, at.number() * normal, normal, cuts);
  if (value.has("name")) value.at("name").fail("one name goes with one plane: give `at` as a number");
  if (at.size() == 0) at.fail("expected at least one place [m]");
  for (const YamlValue& item : at.items()) add_plane(item, item.number() * normal, normal, cuts);
}

void add_planes(const YamlValue& value, std::vector<CutPlane>& cuts) {
  if (value.is_map() && value.has("axis")) return add_planes_along_axis(value, cuts);
  value.check_keys({"point", "normal", "name", "axis", "at"}, "a plane");
  add_plane(value, value.at("point").vector3(), value.at("normal").direction(), cuts);
}

/// Adds planes that divide a straight line into equal parts.
void divide_line(const YamlValue& line, int count, std::vector<CutPlane>& cuts) {
  line.check_keys({"from", "to"}, "a line");
  const Eigen::Vector3d from = line.at("from").vector3(), way = line.at("to").vector3() - from;
  if (way.norm() == 0) line.fail("expected two different points");
  for (int k = 1; k < count; ++k)
    add_plane(line, from + (static_cast<double>(k) / count) * way, way.normalized(), cuts);
}

/// Adds planes through the axis of a circular arc that divide it into equal parts.
void divide_arc(const YamlValue& arc, int count, std::vector<CutPlane>& cuts) {
  arc.check_keys({"from", "centre", "axis", "angle"}, "an arc");
  const Eigen::Vector3d from = arc.at("from").vector3(), centre = arc.at("centre").vector3();
  const Eigen::Vector3d axis = arc.at("axis").direction();
  const Eigen::Vector3d radius = from - centre - axis.dot(from - centre) * axis;
  if (radius.norm() == 0) arc.fail("`from` lies on the axis: expected the point where the arc starts");
  const double angle = arc.at("angle").number();
  if (angle == 0 || std::abs(angle) > 2 * std::numbers::pi)
    arc.at("angle").fail("expected an angle [rad] up to 2 pi about the axis, other than 0");
  for (int k = 1; k < count; ++k) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle * k / count, axis).toRotationMatrix();
    const Eigen::Vector3d point = centre + turn * (from - centre);
    const Eigen::Vector3d tangent = axis.cross(turn * radius).normalized() * (angle > 0 ? 1 : -1);
    add_plane(arc, point, tangent, cuts);
  }
}

int read_count(const YamlValue& value) {
  const int count = value.integer();
  if (count < 2 || count > most_pieces)
    value.fail(
        fmt::format("expected 2 to {} pieces, found {}; without `pieces` the body stays whole", most_pieces, count));
  return count;
}

}  // namespace

PiecesRequest read_pieces(const YamlValue& value, std::vector<CutPlane>& cuts) {
  value.check_keys({"planes", "count", "line", "arc", "tie", "compare"}, "the pieces");
  if (value.has("planes") + value.has("line") + value.has("arc") != 1)
    value.fail("expected exactly one of planes, line (with count), arc (with count)");
  if (value.has("planes")) {
    if (value.has("count")) value.at("count").fail("planes are counted by themselves: remove this key");
    const YamlValue planes = value.at("planes");
    if (planes.is_sequence())
      for (const YamlValue& plane : planes.items()) add_planes(plane, cuts);
    else
      add_planes(planes, cuts);
    if (cuts.empty()) planes.fail("expected at least one plane: {point: [x, y, z], normal: [x, y, z]}");
  } else {
    const int count = read_count(value.at("count"));
    if (value.has("line"))
      divide_line(value.at("line"), count, cuts);
    else
      divide_arc(value.at("arc"), count, cuts);
  }
  PiecesRequest request;
  if (const auto tie = value.find("tie")) request.tie = read_tie(*tie);
  if (const auto compare = value.find("compare")) request.compare = compare->boolean();
  return request;
}

}  // namespace bielle::reduce
