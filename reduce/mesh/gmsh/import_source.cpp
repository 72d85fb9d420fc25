#include "reduce/mesh/gmsh/import_source.hpp"

#include <cmath>

#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/percent.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/checks.hpp"
#include "reduce/mesh/conforming.hpp"
#include "reduce/mesh/gmsh/assembly.hpp"
#include "reduce/mesh/gmsh/cut_geometry.hpp"
#include "reduce/mesh/gmsh/fragments.hpp"
#include "reduce/mesh/gmsh/mesh_geometry.hpp"
#include "reduce/mesh/gmsh/model.hpp"
#include "reduce/mesh/gmsh/volumes.hpp"
#include "reduce/mesh/groups.hpp"
#include "reduce/mesh/measures.hpp"
#include "reduce/mesh/overlaps.hpp"
#include "reduce/mesh/place.hpp"
#include "reduce/mesh/source_file.hpp"
#include "reduce/mesh/straighten.hpp"

namespace bielle::reduce {

namespace {

// Second-order elements are repaired; all other faults are errors.
void check_mesh(const MeshRequest& request, const ExtractedModel& model, const std::vector<std::size_t>& tags,
                const FaceTable& faces, Mesh& mesh, Progress& progress) {
  check_connected(mesh, tags);
  const Straightening repaired = straighten_elements(mesh);
  if (repaired.nodes > 0)
    progress.note(
        fmt::format("{} inside out, or nearly so, at curved surfaces: {} moved to the middle of the edge, by {} at "
                    "most (at {}), which changes the volume by {}; smaller elements avoid it",
                    counted(repaired.elements, "second-order element"), counted(repaired.nodes, "mid-side node"),
                    length_name(repaired.farthest), place_name(repaired.place), percent(repaired.volume_change)));
  if (model.dropped_nodes > 0)
    progress.note(fmt::format("left out: {} of no solid cell", counted(model.dropped_nodes, "node")));
  if (const CoincidentNodes coincident = coincident_nodes(mesh, faces); coincident.pairs > 0)
    progress.warn(fmt::format(
        "{}: {} at the same place, the first at {}: the body is cracked there; merge the nodes if it "
        "should not be",
        request.path, counted(coincident.pairs, "pair of nodes", "pairs of nodes"), place_name(coincident.place)));
  for (const std::string& warning :
       {implausible_size(mesh), loose_joints(mesh, faces, tags), stiff_wedges(mesh, faces)})
    if (!warning.empty()) progress.warn(request.subject, warning);
  if (const MeshQuality quality = mesh_quality(mesh); quality.least_scaled_jacobian < 1e-3)
    progress.warn(request.subject, fmt::format("an element at {} is nearly flat (scaled Jacobian {:.1g}): stresses "
                                               "there mean nothing; another mesh.size avoids it",
                                               place_name(quality.worst_place), quality.least_scaled_jacobian));
}

// Straight edges cut curved surfaces off, those of divided tetrahedra above all.
void warn_of_lost_volume(GmshSession& session, const MeshRequest& request, const SourceFile& source, const Mesh& mesh,
                         Progress& progress) {
  constexpr double most = 0.01;
  double volume = 0;
  session.compute(fmt::format("'{}' cannot be measured", source.name), [&] {
    if (is_open_cascade()) volume = volume_of_solids() * std::pow(source.metres, 3);
  });
  if (volume <= 0) return;
  const double change = mesh_volume(mesh) / volume - 1;
  if (std::abs(change) <= most) return;
  progress.warn(request.mesh_subject,
                fmt::format("the mesh has {} {} volume, and mass, than the geometry: a smaller `size`, or `curvature`, "
                            "which divides curved surfaces finer, avoids it{}",
                            percent(std::abs(change)), change < 0 ? "less" : "more",
                            request.order.value_or(2) == 1 ? "; so does `order: 2`" : ""));
}

// @throws InputError for keys that a mesh cannot have
void refuse_keys_of_geometries(const MeshRequest& request) {
  if (!request.solids.empty())
    throw InputError(request.solids.front().subject,
                     fmt::format("'{}' is a mesh, of which no solids can be selected: remove this key, and the other "
                                 "cells from the mesh",
                                 request.path));
  if (request.glue)
    throw InputError(request.glue_subject, fmt::format("'{}' is a mesh, whose parts cannot be glued: remove this key, "
                                                       "and merge the nodes of the mesh where its parts touch",
                                                       request.path));
  if (request.size || request.order || !request.sizes.empty() || request.hexahedra || request.curvature || request.heal)
    throw InputError(request.mesh_subject, fmt::format("'{}' is a mesh already: remove this key", request.path));
}

}  // namespace

Mesh import_source(const MeshRequest& request, const SourceFile& source, Progress& progress) {
  GmshSession session;
  about(request.subject, [&] { open_model(session, source); });
  std::vector<PhysicalGroup> groups;
  bool geometry = false;
  session.read(fmt::format("'{}' cannot be read", source.name), [&] {
    groups = physical_groups();
    geometry = source.geometry && !model_has_cells(3);
    if (geometry && !model_has_volumes())
      throw InputError(request.subject, fmt::format("'{}' holds no volume: a body is a solid", source.name));
  });
  if (geometry) groups = assemble_solids(session, request, source, progress);
  check_groups(request, groups);
  if (geometry) {
    if (!request.cuts.empty()) groups = cut_geometry(session, request, source, progress);
    mesh_geometry(session, request, source, groups, progress);
  } else {
    refuse_keys_of_geometries(request);
  }

  ExtractedModel model = about(request.subject, [&] { return extract_model(session, source.name, source.metres); });
  Mesh mesh;
  mesh.points = std::move(model.points);
  mesh.blocks = std::move(model.solids);
  const std::vector<std::size_t> tags = geometry ? std::vector<std::size_t>{} : model.cell_tags;
  about(request.subject, [&] { check_repeated_cells(mesh, tags); });
  about(request.subject, [&] {
    try {
      check_elements(mesh, tags);
    } catch (const InputError& error) {
      if (!request.hexahedra.value_or(false)) throw;
      throw InputError(fmt::format("{}; a smaller mesh.size, or tetrahedra, avoid it", error.what()));
    }
  });
  const FaceTable faces = about(request.subject, [&] { return FaceTable(mesh); });
  about(request.subject, [&] { check_sides_of_faces(mesh, faces, tags); });
  about(request.subject, [&] { check_conforming(mesh, faces); });
  about(request.subject, [&] { check_mesh(request, model, tags, faces, mesh, progress); });
  if (geometry) warn_of_lost_volume(session, request, source, mesh, progress);
  add_volume_groups(model, mesh);
  add_surface_groups(request, model, geometry, faces, mesh);
  add_node_groups(request, model, mesh);
  return mesh;
}

}  // namespace bielle::reduce
