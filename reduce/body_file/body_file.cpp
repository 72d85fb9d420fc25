#include "reduce/body_file/body_file.hpp"

#include <map>
#include <optional>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "reduce/body_file/body_axes.hpp"
#include "reduce/body_file/body_interfaces.hpp"
#include "reduce/body_file/body_materials.hpp"
#include "reduce/body_file/body_pieces.hpp"
#include "reduce/body_file/body_points.hpp"
#include "reduce/body_file/body_surfaces.hpp"
#include "reduce/common/input/plausible.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

namespace {

InterfaceRequest read_interface(const std::string& name, const YamlValue& value, MeshRequest& request) {
  value.check_keys({"surface", "tie", "position", "axes", "rotation_vector", "directions"}, "an interface");
  check_name(name, value);
  InterfaceRequest interface;
  interface.name = name;
  interface.subject = value.path();
  interface.group = read_surface(value, "surface", request);
  if (const auto tie = value.find("tie")) interface.tie = read_tie(*tie);
  if (interface.tie == Tie::free) {
    interface.kept = {true, true, true, false, false, false};
    for (const char* key : {"position", "axes", "rotation_vector"})
      if (const auto given = value.find(key))
        given->fail("a free interface is each of its nodes where it is, along the axes of the body: remove this key");
  }
  if (const auto position = value.find("position")) interface.position = position->vector3();
  const auto axes = value.find("axes"), rotation = value.find("rotation_vector");
  if (axes && rotation) value.fail("expected either axes or rotation_vector, not both");
  if (axes) interface.rotation = read_axes(*axes);
  if (rotation) {
    const Eigen::Vector3d psi = rotation->vector3();
    if (psi.norm() > 0) interface.rotation = Eigen::AngleAxisd(psi.norm(), psi.normalized()).toRotationMatrix();
  }
  if (const auto directions = value.find("directions")) interface.kept = read_directions(*directions, interface.tie);
  return interface;
}

LoadRequest read_load(const std::string& name, const YamlValue& value, MeshRequest& request) {
  value.check_keys({"surface", "pressure", "traction", "force", "residual"}, "a load");
  check_name(name, value);
  LoadRequest load;
  load.name = name;
  load.subject = value.path();
  load.group = read_surface(value, "surface", request);
  if (const auto residual = value.find("residual")) load.residual = residual->boolean();
  if (value.has("pressure") + value.has("traction") + value.has("force") != 1)
    value.fail("expected exactly one of pressure [Pa], traction [x, y, z in Pa], force [x, y, z in N]");
  if (const auto pressure = value.find("pressure")) {
    load.pressure = pressure->number();
    if (*load.pressure == 0) pressure->fail("a pattern of zero pressure loads nothing");
    return load;
  }
  const YamlValue vector = value.at(value.has("traction") ? "traction" : "force");
  (value.has("traction") ? load.traction : load.force) = vector.vector3();
  if (vector.vector3().isZero(0)) vector.fail("a pattern of zero force loads nothing");
  return load;
}

void read_mesh(const YamlValue& root, MeshRequest& request) {
  const YamlValue geometry = root.at("geometry");
  request.path = geometry.file_path();
  request.subject = geometry.path();
  if (const auto unit = root.find("length_unit")) {
    request.length_unit = unit->text();
    request.length_unit_subject = unit->path();
  }
  const auto mesh = root.find("mesh");
  if (!mesh) return;
  mesh->check_keys({"size", "order", "sizes"}, "the mesh");
  request.mesh_subject = mesh->path();
  if (const auto size = mesh->find("size")) request.size = size->positive_number();
  if (const auto order = mesh->find("order")) {
    request.order = order->integer();
    if (*request.order != 1 && *request.order != 2)
      order->fail(fmt::format("expected 1 or 2, found {}", *request.order));
  }
  if (const auto sizes = mesh->find("sizes"))
    for (const auto& [name, size] : sizes->entries()) request.sizes[name] = {size.positive_number(), size.path()};
}

// `mesh.sizes` may name interfaces, loads and points: their groups take their place.
void resolve_sizes(const YamlValue& root, const ReductionOptions& options, MeshRequest& request) {
  std::map<std::string, std::string> group_of;
  for (const PointRequest& point : options.points)
    if (!point.group.empty()) group_of[point.name] = point.group;
  for (const LoadRequest& load : options.loads) group_of[load.name] = load.group;
  for (const InterfaceRequest& interface : options.interfaces) group_of[interface.name] = interface.group;
  std::map<std::string, GroupSize> resolved;
  for (const auto& [name, size] : request.sizes) {
    const auto found = group_of.find(name);
    const std::string& group = found == group_of.end() ? name : found->second;
    if (!resolved.emplace(group, size).second)
      root.at("mesh").at("sizes").at(name).fail(fmt::format("the surface '{}' gets its size twice", group));
  }
  request.sizes = resolved;
}

void read_regions(const YamlValue& root, BodyFile& body) {
  ReductionOptions& options = body.options;
  const YamlValue materials = root.at("materials");
  std::vector<std::string> names;
  for (const auto& [name, value] : materials.entries()) {
    options.materials.emplace(name, read_material(value));
    warn_of_material(value);
    names.push_back(name);
  }
  if (names.empty()) materials.fail("expected at least one material");

  const YamlValue regions = root.at("regions");
  for (const auto& [group, value] : regions.entries()) {
    const std::string material = value.text();
    if (!options.materials.contains(material))
      value.fail(fmt::format("there is no material '{}'{}", material, did_you_mean(material, names)));
    options.regions[group] = material;
    body.mesh.volumes.push_back({group, value.path()});
  }
  if (options.regions.empty()) regions.fail("expected at least one region, e.g. all: " + names.front());
  if (options.regions.contains("all") && options.regions.size() > 1)
    regions.fail("'all' is the whole body: with other regions, cells would have two materials");
}

void read_modes(const YamlValue& value, ReductionOptions& options) {
  value.check_keys({"count", "below", "method", "proof"}, "the modes");
  if (const auto count = value.find("count")) {
    options.mode_count = count->integer();
    if (*options.mode_count < 0)
      count->fail(fmt::format("expected a number of at least 0, found {}", *options.mode_count));
  }
  if (const auto below = value.find("below")) options.modes_below = below->positive_number();
  if (const auto method = value.find("method")) {
    const std::string word = method->word({"auto", "arpack", "block_lanczos"}, "a method for modes");
    options.mode_method = word == "arpack"          ? EigenMethod::arpack
                          : word == "block_lanczos" ? EigenMethod::block_lanczos
                                                    : EigenMethod::automatic;
  }
  if (const auto proof = value.find("proof")) options.modes_proven = proof->boolean();
  if (!options.mode_count && !options.modes_below) value.fail("expected how many modes: count, or below [Hz], or both");
}

void read_damping(const YamlValue& value, ReductionOptions& options) {
  value.check_keys({"ratio", "rayleigh"}, "the damping");
  if (value.has("ratio") + value.has("rayleigh") != 1) value.fail("expected either ratio or rayleigh");
  if (const auto ratio = value.find("ratio")) {
    if (ratio->is_sequence())
      for (const YamlValue& item : ratio->items()) options.damping_ratios.push_back(item.non_negative_number());
    else
      options.damping_ratios.push_back(ratio->non_negative_number());
    if (options.damping_ratios.empty()) ratio->fail("expected a number or a list of numbers");
    for (const double each : options.damping_ratios) warn_outside(*ratio, each, plausible_damping_ratio);
    return;
  }
  const YamlValue rayleigh = value.at("rayleigh");
  if (rayleigh.size() != 2) rayleigh.fail("expected [alpha, beta]: alpha [1/s] of the mass, beta [s] of the stiffness");
  options.rayleigh = {rayleigh.at(0).non_negative_number(), rayleigh.at(1).non_negative_number()};
}

RecoveryExtent read_extent(const YamlValue& value) {
  const std::string word = value.word({"none", "surface", "all"}, "an extent of recovery");
  return word == "none" ? RecoveryExtent::none : word == "surface" ? RecoveryExtent::surface : RecoveryExtent::all;
}

void read_recovery(const YamlValue& value, ReductionOptions& options) {
  if (const auto strain = value.find("strain"))
    strain->fail("strain follows from stress and material: `stress: surface` or `stress: all` gives both");
  value.check_keys({"displacement", "stress"}, "the recovery");
  if (const auto displacement = value.find("displacement")) options.displacement_recovery = read_extent(*displacement);
  if (const auto stress = value.find("stress")) options.stress_recovery = read_extent(*stress);
  if (options.stress_recovery == RecoveryExtent::all && options.displacement_recovery == RecoveryExtent::surface)
    value.fail("'stress: all' needs 'displacement: all': the superelement then keeps the whole mesh");
}

void read_parameters(YamlValue& root) {
  if (const auto given = root.find("parameters"))
    for (const auto& [name, value] : given->entries())
      root.set_parameter(name, value.number());  // may use those above it
}

BodyFile read(YamlValue root) {
  root.check_keys({"body", "parameters", "geometry", "length_unit", "mesh", "materials", "regions", "interfaces",
                   "modes", "inertia_relief", "damping", "loads", "points", "recovery", "pieces"},
                  "a body file");
  read_parameters(root);
  BodyFile body;
  body.options.name = root.at("body").text();
  body.options.input_text = root.source_text();
  body.lines = KeyLines(root);
  read_mesh(root, body.mesh);
  read_regions(root, body);
  const YamlValue interfaces = root.at("interfaces");
  for (const auto& [name, value] : interfaces.entries())
    body.options.interfaces.push_back(read_interface(name, value, body.mesh));
  if (body.options.interfaces.empty())
    interfaces.fail(
        "expected at least one: a mechanism moves a body by its interfaces, and one with 'tie: average' on "
        "any surface leaves the body free");
  read_modes(root.at("modes"), body.options);
  if (const auto relief = root.find("inertia_relief")) body.options.inertia_relief = relief->boolean();
  if (const auto damping = root.find("damping")) read_damping(*damping, body.options);
  if (const auto loads = root.find("loads"))
    for (const auto& [name, value] : loads->entries()) body.options.loads.push_back(read_load(name, value, body.mesh));
  if (const auto points = root.find("points")) body.options.points = read_points(*points, body.mesh);
  if (const auto recovery = root.find("recovery")) read_recovery(*recovery, body.options);
  if (const auto pieces = root.find("pieces")) body.pieces = read_pieces(*pieces, body.mesh.cuts);
  resolve_sizes(root, body.options, body.mesh);
  body.warnings = root.warnings();
  return body;
}

}  // namespace

BodyFile read_body_file(const std::string& path) { return read(YamlValue::load(path)); }

BodyFile parse_body_file(const std::string& text, const std::string& name) {
  return read(YamlValue::parse(text, name));
}

GeometryFile read_geometry_of(const std::string& body_path) {
  const YamlValue root = YamlValue::load(body_path);
  const auto unit = root.find("length_unit");
  return {root.at("geometry").file_path(), unit ? std::optional(unit->text()) : std::nullopt};
}

}  // namespace bielle::reduce
