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

const std::vector<std::string> axes = {"x", "y", "z"};

/// Returns the key for the name of a cut.
Key cut_name() { return {"name", keys::text(), keys::computed("`cut_1`, `cut_2`, ..."), "Name of the cut."}; }

const KeyTable& planes_along_axis_keys() {
  using namespace keys;
  static const KeyTable table{
      "planes normal to an axis",
      "One plane or several, normal to an axis of the body.",
      {{"axis", word(axes, "an axis of the body"), required, "Axis of the body to which the planes are normal."},
       {"at",
        {number("m"), list_of(number("m")).items_at_least(1)},
        required,
        "Place of the plane on the axis, or a list of places."},
       cut_name()}};
  return table;
}

const KeyTable& plane_keys() {
  using namespace keys;
  static const KeyTable table{"a plane that cuts",
                              "A plane that cuts the whole body, by a point and its normal.",
                              {{"point", vector3("m"), required, "A point of the plane."},
                               {"normal", direction(), required, "Direction normal to the plane."},
                               cut_name()},
                              {{"axis", "", planes_along_axis_keys}}};
  return table;
}

const KeyTable& line_keys() {
  using namespace keys;
  static const KeyTable table{
      "a line",
      "A straight line, which planes normal to it divide into equal parts.",
      {{"from", vector3("m"), required, "Start of the line."}, {"to", vector3("m"), required, "End of the line."}}};
  return table;
}

const KeyTable& arc_keys() {
  using namespace keys;
  static const KeyTable table{
      "an arc",
      "A circular arc, which planes through its axis divide into equal parts.",
      {{"from", vector3("m"), required, "Start of the arc."},
       {"centre", vector3("m"), required, "A point of the axis about which the arc turns."},
       {"axis", direction(), required, "Direction of that axis."},
       {"angle", number("rad"), required, "Angle of the arc about the axis, up to a full turn and not 0."}}};
  return table;
}

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

/// Adds planes normal to an axis of the body, at one place or several: `{axis: x, at: 0.2}`.
void add_planes_along_axis(const YamlValue& value, std::vector<CutPlane>& cuts) {
  const std::string axis = value.at("axis").word();
  const Eigen::Vector3d normal = Eigen::Vector3d::Unit(std::find(axes.begin(), axes.end(), axis) - axes.begin());
  const YamlValue at = value.at("at");
  if (!at.is_sequence()) return add_plane(value, at.number() * normal, normal, cuts);
  if (value.has("name")) value.at("name").fail("one name goes with one plane: give `at` as a number");
  if (at.size() == 0) at.fail("expected at least one place [m]");
  for (const YamlValue& item : at.items()) add_plane(item, item.number() * normal, normal, cuts);
}

void add_planes(const YamlValue& value, std::vector<CutPlane>& cuts) {
  if (value.is_map() && value.has("axis")) return add_planes_along_axis(value, cuts);
  add_plane(value, value.at("point").vector3(), value.at("normal").direction(), cuts);
}

/// Adds planes that divide a straight line into equal parts.
void divide_line(const YamlValue& line, int count, std::vector<CutPlane>& cuts) {
  const Eigen::Vector3d from = line.at("from").vector3(), way = line.at("to").vector3() - from;
  if (way.norm() == 0) line.fail("expected two different points");
  for (int k = 1; k < count; ++k)
    add_plane(line, from + (static_cast<double>(k) / count) * way, way.normalized(), cuts);
}

/// Adds planes through the axis of a circular arc that divide it into equal parts.
void divide_arc(const YamlValue& arc, int count, std::vector<CutPlane>& cuts) {
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

}  // namespace

const KeyTable& pieces_keys() {
  using namespace keys;
  static const KeyTable table{
      "the pieces",
      "Cuts that divide a body that bends much into several superelements.",
      {{"planes",
        {nested(plane_keys), list_of(nested(plane_keys)).items_at_least(1)},
        optional,
        "A plane or a list of planes that cut the body."},
       {"count", integer().between(2, 1000), optional, "Number of equal parts of the `line` or `arc`."},
       {"line", nested(line_keys), optional, "A straight line that is divided into `count` parts."},
       {"arc", nested(arc_keys), optional, "A circular arc that is divided into `count` parts."},
       {"tie", tie_form(), otherwise("rigid"), "Ties of the cuts, as for interfaces."},
       {"compare", boolean(), otherwise("true"),
        "The uncut body is reduced as well, to measure the effect of the cuts."}}};
  return table;
}

PiecesRequest read_pieces(const YamlValue& value, std::vector<CutPlane>& cuts) {
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
    const int count = value.at("count").integer();
    if (value.has("line"))
      divide_line(value.at("line"), count, cuts);
    else
      divide_arc(value.at("arc"), count, cuts);
  }
  PiecesRequest request;
  request.tie = read_tie(value.at("tie"));
  request.compare = value.at("compare").boolean();
  return request;
}

}  // namespace bielle::reduce
