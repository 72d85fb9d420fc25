#include "reduce/mesh/groups.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/sort_unique.hpp"
#include "reduce/mesh/selectors.hpp"

namespace bielle::reduce {

std::vector<std::string> group_names(const std::vector<PhysicalGroup>& groups, int dimension) {
  std::vector<std::string> names;
  for (const PhysicalGroup& group : groups)
    if (group.dimension == dimension) names.push_back(group.name);
  return names;
}

std::vector<std::string> groups_of(const std::vector<PhysicalGroup>& groups, int dimension, int entity) {
  std::vector<std::string> names;
  for (const PhysicalGroup& group : groups)
    if (group.dimension == dimension &&
        std::find(group.entities.begin(), group.entities.end(), entity) != group.entities.end())
      names.push_back(group.name);
  return names;
}

const PhysicalGroup* find_group(const std::vector<PhysicalGroup>& groups, const std::string& name) {
  for (const PhysicalGroup& group : groups)
    if (group.name == name) return &group;
  return nullptr;
}

namespace {

// "'bore' is no physical surface of rod.geo; did you mean 'bore_big'?"
[[noreturn]] void fail_unknown_group(const std::string& subject, const std::string& name, int dimension,
                                     const std::vector<PhysicalGroup>& groups) {
  const std::string kind = dimension == 2 ? "surface" : "volume";
  const PhysicalGroup* other = find_group(groups, name);
  const std::vector<std::string> names = group_names(groups, dimension);
  std::string advice = names.empty()
                           ? fmt::format("; it has no physical {}s{}", kind, dimension == 3 ? ": use all" : "")
                           : did_you_mean(name, names);
  if (other != nullptr)
    throw InputError(subject, fmt::format("'{}' is a physical {} of the geometry, but a {} is needed{}", name,
                                          other->dimension == 2 ? "surface" : "volume", kind, advice));
  if (dimension == 2 && names.empty())
    advice += "; select by shape: {cylinder: {point, axis, radius}}, {plane: {point, normal}} or {box: [[..], [..]]}";
  throw InputError(subject, fmt::format("'{}' is not a physical {} of the geometry{}", name, kind, advice));
}

// Faces of solid cells that are the surface cells of an entity.
std::vector<int> faces_of(const std::vector<Corners>& cells, const FaceTable& faces, const std::string& group) {
  std::vector<int> found;
  for (const Corners& cell : cells) {
    const std::optional<int> face = cell.contains(-1) ? std::nullopt : faces.find(cell);
    if (!face)
      throw InputError(
          fmt::format("surface group '{}' holds a {} that is no face of a solid cell: shells and loose "
                      "surfaces are not reduced",
                      group, cell.size() == 3 ? "triangle" : "quadrilateral"));
    found.push_back(*face);
  }
  return found;
}

// Adds cells of one block and their nodes to a group.
void add_part(Group& group, const CellBlock& block, std::vector<int> cells) {
  sort_unique(cells);
  for (int cell : cells)
    group.nodes.insert(group.nodes.end(), block.nodes.col(cell).begin(), block.nodes.col(cell).end());
  sort_unique(group.nodes);
  group.parts.push_back({block.type, std::move(cells)});
}

// Faces of every surface group of the requested mesh, by name.
std::map<std::string, std::vector<int>> surface_groups(const MeshRequest& request, const ExtractedModel& model,
                                                       const Mesh& mesh, const FaceTable& faces, bool geometry) {
  std::map<std::string, std::vector<int>> result;
  for (const PhysicalGroup& group : model.groups) {
    if (group.dimension != 2) continue;
    std::vector<int>& of_group = result[group.name];
    for (int entity : group.entities)
      if (const auto found = model.surfaces.find(entity); found != model.surfaces.end())
        for (int face : faces_of(found->second, faces, group.name)) of_group.push_back(face);
  }

  const BodySurface surface = body_surface(model, faces, geometry);
  for (const SurfaceSelection& selection : request.surfaces) {
    std::vector<int> selected;
    for (const SurfaceSelector& selector : selection.selectors) {
      if (const auto* name = std::get_if<std::string>(&selector)) {
        const std::vector<int>& of_group = result.at(*name);
        if (of_group.empty())
          throw InputError(selection.subject, fmt::format("the physical surface '{}' is empty", *name));
        selected.insert(selected.end(), of_group.begin(), of_group.end());
        continue;
      }
      const std::vector<int> sides = about(
          selection.subject, [&] { return select_sides(std::get<ShapeSelector>(selector), mesh.points, surface); });
      for (int side : sides) selected.push_back(surface.faces[side]);
    }
    result[selection.group] = selected;
  }
  return result;
}

}  // namespace

void check_groups(const MeshRequest& request, const std::vector<PhysicalGroup>& groups) {
  const auto is = [&](const std::string& name, int dimension) {
    const PhysicalGroup* group = find_group(groups, name);
    return group != nullptr && group->dimension == dimension;
  };
  for (const SurfaceSelection& selection : request.surfaces)
    for (const SurfaceSelector& selector : selection.selectors)
      if (const auto* name = std::get_if<std::string>(&selector); name != nullptr && !is(*name, 2))
        fail_unknown_group(selection.subject, *name, 2, groups);
  for (const VolumeSelection& volume : request.volumes)
    if (volume.group != "all" && !is(volume.group, 3)) fail_unknown_group(volume.subject, volume.group, 3, groups);
}

void add_volume_groups(const ExtractedModel& model, Mesh& mesh) {
  const SolidCells solids(mesh);
  for (const PhysicalGroup& group : model.groups) {
    if (group.dimension != 3) continue;
    std::vector<int> cells;
    for (int entity : group.entities)
      if (const auto found = model.volumes.find(entity); found != model.volumes.end())
        cells.insert(cells.end(), found->second.begin(), found->second.end());
    if (!cells.empty()) mesh.groups[group.name] = solids.group_of(cells);
  }
  if (!group_names(model.groups, 3).empty()) return;
  std::vector<int> all(solids.size());
  std::iota(all.begin(), all.end(), 0);
  mesh.groups["all"] = solids.group_of(all);
}

void add_node_groups(const MeshRequest& request, const ExtractedModel& model, Mesh& mesh) {
  if (request.nodes.empty()) return;
  std::map<std::size_t, int> number;
  for (std::size_t i = 0; i < model.node_tags.size(); ++i) number.emplace(model.node_tags[i], static_cast<int>(i));
  for (const NodeSelection& selection : request.nodes) {
    std::map<int, double> weights;
    for (std::size_t k = 0; k < selection.tags.size(); ++k) {
      const auto found = number.find(selection.tags[k]);
      if (found == number.end())
        throw InputError(selection.subject, fmt::format("node {} belongs to no solid cell", selection.tags[k]));
      weights[found->second] += selection.weights[k];
    }
    Group group;
    for (const auto& [node, weight] : weights) {
      group.nodes.push_back(node);
      group.weights.push_back(weight);
    }
    mesh.groups[selection.group] = std::move(group);
  }
}

void add_surface_groups(const MeshRequest& request, const ExtractedModel& model, bool geometry, const FaceTable& faces,
                        Mesh& mesh) {
  add_surface_cells(surface_groups(request, model, mesh, faces, geometry), faces, mesh);
}

void add_surface_cells(const std::map<std::string, std::vector<int>>& groups, const FaceTable& faces, Mesh& mesh) {
  std::map<CellType, std::map<int, int>> cells_of;  // face -> surface cell of its type
  for (const auto& [name, members] : groups)
    for (int face : members) cells_of[faces.type(face)].emplace(face, 0);
  std::map<CellType, CellBlock> blocks;
  for (auto& [type, cell_of] : cells_of) {
    CellBlock block{type, Eigen::MatrixXi(node_count(type), cell_of.size())};
    int next = 0;
    for (auto& [face, cell] : cell_of) {
      cell = next++;
      block.nodes.col(cell) = faces.nodes(face);
    }
    blocks[type] = std::move(block);
  }
  for (const auto& [name, members] : groups) {
    if (members.empty()) continue;
    std::map<CellType, std::vector<int>> cells;
    for (int face : members) cells[faces.type(face)].push_back(cells_of.at(faces.type(face)).at(face));
    Group group{2};
    for (auto& [type, of_type] : cells) add_part(group, blocks.at(type), std::move(of_type));
    mesh.groups[name] = std::move(group);
  }
  for (auto& [type, block] : blocks) mesh.blocks.push_back(std::move(block));
}

}  // namespace bielle::reduce
