#include "reduce/mesh/import.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/checks.hpp"
#include "reduce/mesh/foreign_mesh.hpp"
#include "reduce/mesh/gmsh_model.hpp"
#include "reduce/mesh/groups.hpp"
#include "reduce/mesh/place.hpp"
#include "reduce/mesh/selectors.hpp"
#include "reduce/mesh/source_file.hpp"
#include "reduce/mesh/straighten.hpp"

namespace bielle::reduce {

namespace {

std::optional<double> in_unit(std::optional<double> length, double metres) {
  if (length) *length /= metres;
  return length;
}

// Entities of the geometry on which `sizes` asks for another edge length than elsewhere.
std::vector<EntitySize> entity_sizes(GmshSession& session, const MeshRequest& request, const SourceFile& source,
                                     const std::vector<PhysicalGroup>& groups) {
  std::vector<EntitySize> result;
  BodySurface surface;  // triangles of a first mesh, made when a shape needs it
  Eigen::Matrix3Xd points;
  for (const auto& [name, wish] : request.sizes) {
    if (const PhysicalGroup* group = find_group(groups, name)) {
      result.push_back({group->dimension, group->entities, wish.size / source.metres});
      continue;
    }
    const auto selection = std::find_if(request.surfaces.begin(), request.surfaces.end(),
                                        [&](const SurfaceSelection& s) { return s.group == name; });
    if (selection == request.surfaces.end()) {
      std::vector<std::string> names = group_names(groups, 2);
      for (const std::string& volume : group_names(groups, 3)) names.push_back(volume);
      for (const SurfaceSelection& s : request.surfaces) names.push_back(s.group);
      throw InputError(at_place(
          wish.located, fmt::format("'{}' is no physical group and no interface{}", name, did_you_mean(name, names))));
    }
    if (surface.triangles.empty()) {
      mesh_model(session, source.name, 2, in_unit(request.size, source.metres), {});
      surface = body_surface(extract_surfaces(session, source.name, source.metres, points));
    }
    std::set<int> entities;
    for (const SurfaceSelector& selector : selection->selectors) {
      if (const auto* group_name = std::get_if<std::string>(&selector)) {
        const std::vector<int>& of_group = find_group(groups, *group_name)->entities;
        entities.insert(of_group.begin(), of_group.end());
        continue;
      }
      const std::vector<int> triangles = placed(
          selection->located, [&] { return select_triangles(std::get<ShapeSelector>(selector), points, surface); });
      for (int triangle : triangles) entities.insert(surface.entities[triangle]);
    }
    result.push_back({2, {entities.begin(), entities.end()}, wish.size / source.metres});
  }
  return result;
}

void mesh_geometry(GmshSession& session, const MeshRequest& request, const SourceFile& source,
                   const std::vector<PhysicalGroup>& groups, Progress& progress) {
  const std::string ending = std::filesystem::path(source.name).extension().string();
  if (!request.size && !ending.starts_with(".geo"))
    throw InputError(at_place(
        request.located,
        fmt::format("'{}' is a geometry: say how fine to mesh it, e.g. mesh: {{size: 3e-3}} [m]", source.name)));
  progress.start("meshing " + std::filesystem::path(source.name).filename().string());
  const std::vector<EntitySize> sizes = entity_sizes(session, request, source, groups);
  placed(request.located, [&] {
    mesh_model(session, source.name, 3, in_unit(request.size, source.metres), sizes);
    if (request.order.value_or(2) == 2) make_second_order(session, source.name);
  });
}

// Second-order elements are made sound, everything else must be.
void check_mesh(const MeshRequest& request, const ExtractedModel& model, const FaceTable& faces, Mesh& mesh,
                Progress& progress) {
  check_connected(mesh);
  const Straightening repaired = straighten_elements(mesh);
  if (repaired.nodes > 0)
    progress.note(fmt::format(
        "{} second-order elements were or might be inside out at curved surfaces: {} mid-side nodes were moved "
        "to the middle of their edges, by {} at most (at {}); smaller elements avoid it",
        repaired.elements, repaired.nodes, length_name(repaired.farthest), place_name(repaired.place)));
  if (model.dropped_nodes > 0)
    progress.note(fmt::format("{} nodes that belong to no solid cell were left out", model.dropped_nodes));
  if (const CoincidentNodes coincident = coincident_nodes(mesh, faces); coincident.pairs > 0)
    progress.warn(
        fmt::format("{}: {} pairs of nodes lie at the same place, the first at {}: the body is cracked there; "
                    "merge the nodes if it should not be",
                    request.path, coincident.pairs, place_name(coincident.place)));
  for (const std::string& doubt : {doubtful_size(mesh), loose_joints(mesh, faces)})
    if (!doubt.empty()) progress.warn(at_place(request.located, doubt));
  if (const MeshQuality quality = mesh_quality(mesh); quality.least_scaled_jacobian < 1e-3)
    progress.warn(
        at_place(request.located, fmt::format("an element at {} is nearly flat (scaled Jacobian {:.1g}): stresses "
                                              "there mean nothing; another mesh.size avoids it",
                                              place_name(quality.worst_place), quality.least_scaled_jacobian)));
}

}  // namespace

Mesh import_mesh(const MeshRequest& request, Progress& progress) {
  progress.start("reading " + std::filesystem::path(request.path).filename().string());
  const SourceFile source = prepare_source(request, progress);
  GmshSession session;
  placed(request.located, [&] { open_model(session, source); });
  std::vector<PhysicalGroup> groups;
  bool geometry = false;
  session.read(fmt::format("'{}' cannot be read", source.name), [&] {
    groups = physical_groups();
    geometry = source.geometry && !model_has_cells(3);
    if (geometry && !model_has_volumes())
      throw InputError(at_place(request.located, fmt::format("'{}' holds no volume: a body is a solid", source.name)));
  });
  check_groups(request, groups);
  if (geometry) {
    mesh_geometry(session, request, source, groups, progress);
  } else if (request.size || request.order || !request.sizes.empty()) {
    throw InputError(
        at_place(request.mesh_located, fmt::format("'{}' is a mesh already: remove this key", request.path)));
  }

  ExtractedModel model = placed(request.located, [&] { return extract_model(session, source.name, source.metres); });
  Mesh mesh;
  mesh.points = std::move(model.points);
  mesh.blocks.push_back(std::move(model.solids));
  placed(request.located, [&] { check_elements(mesh, geometry ? std::vector<std::size_t>{} : model.cell_tags); });
  const FaceTable faces = placed(request.located, [&] { return FaceTable(mesh); });
  placed(request.located, [&] { check_mesh(request, model, faces, mesh, progress); });
  add_volume_groups(model, mesh);
  add_surface_groups(request, model, geometry, faces, mesh);
  return mesh;
}

}  // namespace bielle::reduce
