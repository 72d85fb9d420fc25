#include "reduce/body_file/body_surfaces.hpp"

#include <optional>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

namespace {

const KeyTable& cylinder_shape_keys() {
  using namespace keys;
  static const KeyTable table{"a cylinder",
                              "A circular cylinder without ends.",
                              {{"point", vector3("m"), required, "A point of its axis."},
                               {"axis", direction(), required, "Direction of its axis."},
                               {"radius", number("m").positive(), required, "Its radius."}}};
  return table;
}

const KeyTable& plane_shape_keys() {
  using namespace keys;
  static const KeyTable table{"a plane",
                              "A plane without bounds.",
                              {{"point", vector3("m"), required, "A point of the plane."},
                               {"normal", direction(), required, "Direction normal to the plane."}}};
  return table;
}

const KeyTable& shape_keys() {
  using namespace keys;
  static const KeyTable table{
      "a surface given by its shape",
      "A shape on which a surface lies, within 1e-4 of the diagonal of the body's box; with several shapes it lies on "
      "all of them.",
      {{"cylinder", nested(cylinder_shape_keys), optional, "A circular cylinder on which the surface lies."},
       {"plane", nested(plane_shape_keys), optional, "A plane on which the surface lies."},
       {"box", list_of(2, vector3("m")), optional,
        "Two opposite corners of a box along the axes of the body, in which the surface lies."}}};
  return table;
}

std::optional<CylinderSelector> read_cylinder(const std::optional<YamlValue>& value) {
  if (!value) return {};
  return CylinderSelector{value->at("point").vector3(), value->at("axis").direction(), value->at("radius").number()};
}

std::optional<PlaneSelector> read_plane(const std::optional<YamlValue>& value) {
  if (!value) return {};
  return PlaneSelector{value->at("point").vector3(), value->at("normal").direction()};
}

std::optional<BoxSelector> read_box(const std::optional<YamlValue>& value) {
  if (!value) return {};
  if (value->size() != 2) value->fail("expected two opposite corners: [[x, y, z], [x, y, z]]");
  const Eigen::Vector3d a = value->at(0).vector3(), b = value->at(1).vector3();
  return BoxSelector{a.cwiseMin(b), a.cwiseMax(b)};
}

SurfaceSelector read_selector(const YamlValue& value) {
  if (value.is_scalar()) return value.text();
  if (value.entries().empty())
    value.fail("expected a shape: cylinder, plane or box, or several that it lies on at once");
  return ShapeSelector(read_cylinder(value.find("cylinder")), read_plane(value.find("plane")),
                       read_box(value.find("box")));
}

}  // namespace

KeyForms surface_forms() {
  using namespace keys;
  const KeyForms one = {name_of("physical surface"), nested(shape_keys)};
  return {one[0], one[1], list_of(one).items_at_least(1)};
}

std::string read_surface(const YamlValue& owner, const std::string& key, MeshRequest& request) {
  const YamlValue value = owner.at(key);
  SurfaceSelection selection;
  selection.subject = value.path();
  if (value.is_sequence()) {
    for (const YamlValue& item : value.items()) selection.selectors.push_back(read_selector(item));
    if (selection.selectors.empty()) value.fail("expected at least one surface");
  } else {
    selection.selectors.push_back(read_selector(value));
  }
  const auto* physical = std::get_if<std::string>(&selection.selectors.front());
  selection.group = physical != nullptr && selection.selectors.size() == 1 ? *physical : owner.path();
  request.surfaces.push_back(selection);
  return selection.group;
}

}  // namespace bielle::reduce
