#include "reduce/mesh/gmsh/mesh_geometry.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/common/sort_unique.hpp"
#include "reduce/mesh/gmsh/hexahedra.hpp"
#include "reduce/mesh/gmsh/meshing.hpp"
#include "reduce/mesh/groups.hpp"
#include "reduce/mesh/place.hpp"
#include "reduce/mesh/selectors.hpp"

namespace bielle::reduce {

namespace {

// The first number is far above the capacity of a large machine; the second takes an hour and tens of gigabytes.
constexpr double most_cells = 20e6, many_cells = 3e6;
constexpr double freedoms_per_cell = 4.3;  // degrees of freedom per cell of tet10

// Refuses meshes that are too large for any machine, and announces meshes that take long.
void check_cell_count(GmshSession& session, const MeshRequest& request, const SourceFile& source,
                      const MeshSizes& sizes, Progress& progress) {
  const double cells = expected_cells(session, source.name, sizes);
  if (cells <= many_cells) return;
  double least = sizes.largest.value_or(0);
  for (const EntitySize& wish : sizes.on_entities) least = least > 0 ? std::min(least, wish.size) : wish.size;
  const std::string body = fmt::format("the body is {} long", length_name(source.metres * model_extent(session)));
  if (cells > most_cells)
    throw InputError(
        request.mesh_subject,
        fmt::format("elements of {} would be about {:.2g} ({}), and more than {:.0f} million are not meshed: {}",
                    length_name(source.metres * least), cells, body, 1e-6 * most_cells,
                    source.carries_unit ? "are the sizes in metres?"
                                        : fmt::format("is the geometry's length_unit {}, and are the sizes in metres?",
                                                      request.length_unit.value_or("m"))));
  progress.warn(request.mesh_subject,
                fmt::format("about {:.2g} elements with {:.2g} degrees of freedom will be meshed ({}): this "
                            "takes hours and much memory; a larger size may serve",
                            cells, freedoms_per_cell * cells, body));
}

// Names mesh sizes that are larger than the body and therefore have no effect, probably because they are in
// millimetres.
void warn_of_sizes(GmshSession& session, const MeshRequest& request, const SourceFile& source, Progress& progress) {
  const double extent = source.metres * model_extent(session);
  const auto warning = [&](const std::string& subject, double size) {
    if (size > extent)
      progress.warn(subject, fmt::format("a size of {:.6g} m is more than the body, which is {} long: sizes are in "
                                         "metres, whatever the unit of the geometry; was {:.6g}e-3 meant?",
                                         size, length_name(extent), size));
  };
  if (request.size) warning(request.mesh_subject, *request.size);
  for (const auto& [name, wish] : request.sizes) warning(wish.subject, wish.size);
}

// The surfaces of a selection.
std::vector<int> selected_entities(const SurfaceSelection& selection, const std::vector<PhysicalGroup>& groups,
                                   const Eigen::Matrix3Xd& points, const BodySurface& surface) {
  std::set<int> entities;
  for (const SurfaceSelector& selector : selection.selectors) {
    if (const auto* group_name = std::get_if<std::string>(&selector)) {
      const std::vector<int>& of_group = find_group(groups, *group_name)->entities;
      entities.insert(of_group.begin(), of_group.end());
      continue;
    }
    const std::vector<int> sides =
        about(selection.subject, [&] { return select_sides(std::get<ShapeSelector>(selector), points, surface); });
    for (int side : sides) entities.insert(surface.entities[side]);
  }
  return {entities.begin(), entities.end()};
}

bool selects_by_shape(const SurfaceSelection& selection) {
  return std::any_of(selection.selectors.begin(), selection.selectors.end(),
                     [](const SurfaceSelector& s) { return std::holds_alternative<ShapeSelector>(s); });
}

// Throws if a selection by shape contains no surface of the surface mesh.
void check_selections(GmshSession& session, const MeshRequest& request, const SourceFile& source,
                      const std::vector<PhysicalGroup>& groups) {
  if (std::none_of(request.surfaces.begin(), request.surfaces.end(), selects_by_shape)) return;
  Eigen::Matrix3Xd points;
  const BodySurface surface = body_surface(extract_surfaces(session, source.name, source.metres, points));
  for (const SurfaceSelection& selection : request.surfaces) selected_entities(selection, groups, points, surface);
}

// Physical groups, and the names of interfaces, loads, points and masses with surfaces of their own.
std::vector<std::string> names_for_sizes(const MeshRequest& request, const std::vector<PhysicalGroup>& groups) {
  std::vector<std::string> names = group_names(groups, 2);
  for (const std::string& volume : group_names(groups, 3)) names.push_back(volume);
  for (const SurfaceSelection& s : request.surfaces)
    names.push_back(find_group(groups, s.group) ? s.group : s.group.substr(s.group.find('.') + 1));  // "masses.paint"
  sort_unique(names);
  return names;
}

// Entities of the geometry for which `sizes` requests another edge length than elsewhere.
std::vector<EntitySize> entity_sizes(GmshSession& session, const MeshRequest& request, const SourceFile& source,
                                     const std::vector<PhysicalGroup>& groups, const MeshSizes& plain) {
  std::vector<EntitySize> result;
  BodySurface surface;  // that of a first mesh, made when a shape needs it
  Eigen::Matrix3Xd points;
  for (const auto& [name, wish] : request.sizes) {
    if (const PhysicalGroup* group = find_group(groups, name)) {
      result.push_back({group->dimension, group->entities, wish.size / source.metres});
      continue;
    }
    const auto selection = std::find_if(request.surfaces.begin(), request.surfaces.end(),
                                        [&](const SurfaceSelection& s) { return s.group == name; });
    if (selection == request.surfaces.end()) {
      throw InputError(wish.subject, fmt::format("'{}' is no physical group, interface, load, point or mass{}", name,
                                                 did_you_mean(name, names_for_sizes(request, groups))));
    }
    if (surface.sides.empty()) {
      mesh_surfaces(session, source.name, plain);
      surface = body_surface(extract_surfaces(session, source.name, source.metres, points));
    }
    result.push_back({2, selected_entities(*selection, groups, points, surface), wish.size / source.metres});
  }
  return result;
}

}  // namespace

void mesh_geometry(GmshSession& session, const MeshRequest& request, const SourceFile& source,
                   const std::vector<PhysicalGroup>& groups, Progress& progress) {
  const std::filesystem::path path(source.name);
  if (!request.size && !path.extension().string().starts_with(".geo"))
    throw InputError(
        request.subject,
        fmt::format("'{}' is a geometry: say how fine to mesh it, e.g. mesh: {{size: 3e-3}} [m]", source.name));
  progress.start("meshing " + path.filename().string());
  MeshSizes sizes;
  if (request.size) sizes.largest = *request.size / source.metres;
  sizes.per_turn = request.curvature;
  check_cell_count(session, request, source, sizes, progress);
  warn_of_sizes(session, request, source, progress);
  sizes.on_entities = entity_sizes(session, request, source, groups, sizes);
  if (!sizes.on_entities.empty()) check_cell_count(session, request, source, sizes, progress);
  about(request.subject, [&] { mesh_surfaces(session, source.name, sizes); });
  check_selections(session, request, source, groups);
  const bool hexahedra = request.hexahedra.value_or(false);
  about(request.subject, [&] {
    if (hexahedra)
      progress.note(describe(mesh_hexahedra(session, source.name, sizes)));
    else
      mesh_volumes(session, source.name, sizes);
    if (request.order.value_or(2) == 2) make_second_order(session, source.name, !hexahedra);
  });
}

}  // namespace bielle::reduce
