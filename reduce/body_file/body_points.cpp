#include "reduce/body_file/body_points.hpp"

#include "reduce/body_file/body_interfaces.hpp"
#include "reduce/body_file/body_surfaces.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

namespace {

std::array<bool, 6> read_residual(const YamlValue& value) {
  if (value.is_sequence()) return read_directions(value);
  std::array<bool, 6> all{};
  all.fill(value.boolean());
  return all;
}

PointRequest read_point(const std::string& name, const YamlValue& value, MeshRequest& mesh) {
  value.check_keys({"group", "at", "position", "residual"}, "a point");
  check_name(name, value);
  PointRequest point;
  point.name = name;
  point.subject = value.path();
  if (value.has("group") == value.has("at"))
    value.fail("expected either `group`, a surface whose mean the point follows, or `at`, its place [x, y, z in m]");
  if (value.has("group")) {
    point.group = read_surface(value, "group", mesh);
    if (const auto position = value.find("position")) point.position = position->vector3();
  } else {
    if (const auto position = value.find("position")) position->fail("`at` is its position: remove this key");
    point.position = value.at("at").vector3();
  }
  if (const auto residual = value.find("residual")) point.residual = read_residual(*residual);
  return point;
}

}  // namespace

std::vector<PointRequest> read_points(const YamlValue& value, MeshRequest& mesh) {
  std::vector<PointRequest> points;
  for (const auto& [name, entry] : value.entries()) points.push_back(read_point(name, entry, mesh));
  return points;
}

}  // namespace bielle::reduce
