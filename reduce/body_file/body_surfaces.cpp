#include "reduce/body_file/body_surfaces.hpp"

#include <optional>

#include "reduce/body_file/body_interfaces.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

namespace {

std::optional<CylinderSelector> read_cylinder(const std::optional<YamlValue>& value) {
  if (!value) return {};
  value->check_keys({"point", "axis", "radius"}, "a cylinder");
  return CylinderSelector{value->at("point").vector3(), value->at("axis").direction(),
                          value->at("radius").positive_number()};
}

std::optional<PlaneSelector> read_plane(const std::optional<YamlValue>& value) {
  if (!value) return {};
  value->check_keys({"point", "normal"}, "a plane");
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
  value.check_keys({"cylinder", "plane", "box"}, "a surface given by its shape");
  if (value.entries().empty())
    value.fail("expected a shape: cylinder, plane or box, or several that it lies on at once");
  return ShapeSelector(read_cylinder(value.find("cylinder")), read_plane(value.find("plane")),
                       read_box(value.find("box")));
}

}  // namespace

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
