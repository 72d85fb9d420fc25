#include "reduce/body_file/body_mesh.hpp"

#include <map>

#include <fmt/format.h>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

namespace {

SolidSelection read_solid(const YamlValue& value) {
  if (!value.is_scalar() || value.is_null()) value.fail("expected a volume, by its number or its name");
  return {value.text(), value.path()};
}

void read_solids(const YamlValue& root, MeshRequest& request) {
  const auto volume = root.find("volume"), volumes = root.find("volumes");
  if (volume && volumes) volume->fail("expected either volume, or volumes");
  if (volume) request.solids.push_back(read_solid(*volume));
  if (volumes) {
    for (const YamlValue& item : volumes->items()) request.solids.push_back(read_solid(item));
    if (request.solids.empty()) volumes->fail("expected at least one volume, by its number or its name");
  }
  if (const auto glue = root.find("glue")) {
    request.glue = glue->boolean();
    request.glue_subject = glue->path();
  }
}

/// A surface that is named after the interface, load or other request that uses it.
struct NamedSurface {
  std::string name, group;
  const char* kind;  ///< "an interface"
};

std::vector<NamedSurface> named_surfaces(const ReductionOptions& options) {
  std::vector<NamedSurface> surfaces;
  const auto add = [&](const auto& requests, const char* kind) {
    for (const auto& request : requests)
      if (!request.group.empty()) surfaces.push_back({request.name, request.group, kind});
  };
  add(options.interfaces, "an interface");
  add(options.loads, "a load");
  add(options.points, "a point");
  add(options.masses, "a mass");
  add(options.coatings, "a mass");
  return surfaces;
}

}  // namespace

const KeyTable& mesh_keys() {
  using namespace keys;
  static const KeyTable table{
      "the mesh",
      "Elements into which a geometry is meshed; a file that contains a mesh needs no `mesh`.",
      {{"size", number("m").positive(), optional,
        "Length of edges at which the mesh aims. A `.geo` may do without, other geometries may not."},
       {"cells", word({"tetrahedra", "hexahedra"}, "a kind of cells"), otherwise("tetrahedra"),
        "Kind of elements. Blocks of six faces are meshed by grids of hexahedra; in other geometries tetrahedra of "
        "twice the size are divided into four hexahedra each."},
       {"order", integer().between(1, 2), otherwise("2"),
        "Order of the elements: 1 for tetrahedra with 4 nodes or hexahedra with 8, 2 for 10 or 20. Tetrahedra of "
        "order 1 are far too stiff in bending."},
       {"curvature", integer().between(3, 360), optional,
        "Number of edges on a full circle of curved surfaces, at least; edges that follow from it are not shorter "
        "than a twentieth of `size`."},
       {"heal", boolean(), otherwise("false"),
        "Edges and faces smaller than a hundredth of `size` are removed, and faces are sewn together, before the "
        "geometry is meshed; it must have no physical surfaces."},
       {"sizes", entries("physical group, interface, load, point or mass", {number("m").positive()}), optional,
        "Other sizes on physical groups, or on the surfaces of interfaces, loads, points and masses; they fade into "
        "`size` away from them."}}};
  return table;
}

void read_mesh(const YamlValue& root, MeshRequest& request) {
  const YamlValue geometry = root.at("geometry");
  request.path = geometry.file_path();
  request.subject = geometry.path();
  if (const auto unit = root.find("length_unit")) {
    request.length_unit = unit->word();
    request.length_unit_subject = unit->path();
  }
  read_solids(root, request);
  const auto mesh = root.find("mesh");
  if (!mesh) return;
  request.mesh_subject = mesh->path();
  if (const auto size = mesh->find("size")) request.size = size->number();
  if (const auto order = mesh->find("order")) request.order = order->integer();
  if (const auto cells = mesh->find("cells")) request.hexahedra = cells->word() == "hexahedra";
  if (const auto curvature = mesh->find("curvature")) request.curvature = curvature->integer();
  if (const auto heal = mesh->find("heal")) {
    request.heal = heal->boolean();
    request.heal_subject = heal->path();
  }
  if (const auto sizes = mesh->find("sizes"))
    for (const auto& [name, size] : sizes->entries()) request.sizes[name] = {size.number(), size.path()};
}

void resolve_sizes(const YamlValue& root, const ReductionOptions& options, MeshRequest& request) {
  const std::vector<NamedSurface> surfaces = named_surfaces(options);
  std::map<std::string, std::string> name_of;  // group -> name under which a size was given for it
  std::map<std::string, GroupSize> resolved;
  for (const auto& [name, size] : request.sizes) {
    const NamedSurface* found = nullptr;
    for (const NamedSurface& surface : surfaces) {
      if (surface.name != name) continue;
      if (found && found->group != surface.group)
        root.at("mesh").at("sizes").at(name).fail(
            fmt::format("{} and {} have the name '{}', but other surfaces: give one of them another name", found->kind,
                        surface.kind, name));
      found = &surface;
    }
    const std::string& group = found ? found->group : name;
    if (const auto [earlier, is_new] = name_of.emplace(group, name); !is_new)
      root.at("mesh").at("sizes").at(name).fail(
          fmt::format("the surface of '{}' has a size by the name '{}' already", name, earlier->second));
    resolved.emplace(group, size);
  }
  request.sizes = resolved;
}

}  // namespace bielle::reduce
