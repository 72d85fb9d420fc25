#include "reduce/body_file/body_points.hpp"

#include "reduce/body_file/body_interfaces.hpp"
#include "reduce/body_file/body_surfaces.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

namespace {

PointRequest read_point(const std::string& name, const YamlValue& value, MeshRequest& mesh) {
  check_name(name, value);
  PointRequest point;
  point.name = name;
  point.subject = value.path();
  if (const auto node = value.find("node")) node->fail("it belongs to a body of `matrices`; this body has a geometry");
  if (value.has("group") == value.has("at"))
    value.fail("expected either `group`, a surface whose mean the point follows, or `at`, its place [x, y, z in m]");
  if (value.has("group")) {
    point.group = read_surface(value, "group", mesh);
    if (const auto position = value.find("position")) point.position = position->vector3();
  } else {
    if (const auto position = value.find("position")) position->fail("`at` is its position: remove this key");
    point.position = value.at("at").vector3();
  }
  point.residual = read_residual(value.at("residual"));
  return point;
}

}  // namespace

std::array<bool, 6> read_residual(const YamlValue& value) {
  if (value.is_sequence()) return read_directions(value);
  std::array<bool, 6> all{};
  all.fill(value.boolean());
  return all;
}

const KeyTable& point_keys() {
  using namespace keys;
  static const KeyTable table{
      "a point",
      "A named point inside the body, which a mechanism uses without the displacements of the mesh.",
      {{"node", integer().positive(), optional, "With `matrices`: a node, in place of `group`."},
       {"group", surface_forms(), optional,
        "A surface, which may touch interfaces; the point moves as its area-weighted mean, as the node of an interface "
        "with `tie: average` does, but does not constrain it."},
       {"at", vector3("m"), optional,
        "A place in the mesh, in place of `group`; the point follows the field that is linear in space and nearest to "
        "the displacements of the 15 nodes around it."},
       {"position", vector3("m"), computed("the centroid of the surface"),
        "Position of the point of a `group`, connected by a rigid arm."},
       {"residual",
        {boolean(), directions_form()},
        otherwise("false"),
        "Forces and moments on the point, in the axes of the body, that get residual vectors; `true` for all six."}}};
  return table;
}

std::vector<PointRequest> read_points(const YamlValue& value, MeshRequest& mesh) {
  std::vector<PointRequest> points;
  for (const auto& [name, entry] : value.entries()) points.push_back(read_point(name, entry, mesh));
  return points;
}

}  // namespace bielle::reduce
