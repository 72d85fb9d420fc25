#include "reduce/mesh/mesh_part.hpp"

#include "reduce/mesh/groups.hpp"

namespace bielle::reduce {

SurfaceFaces surface_faces(const Mesh& mesh, const FaceTable& faces) {
  SurfaceFaces result;
  for (const auto& [name, group] : mesh.groups) {
    if (group.dimension != 2) continue;
    for (const GroupPart& part : group.parts) {
      const Eigen::MatrixXi& nodes = mesh.block(part.type)->nodes;
      for (const int cell : part.cells)
        if (const auto face = faces.find(corners_of(part.type, nodes.col(cell)))) result[name].push_back(*face);
    }
  }
  return result;
}

MeshExtraction::MeshExtraction(const Mesh& whole, const std::vector<int>& parts, int part)
    : whole_(whole), number_in_part_(whole.point_count(), -1), cell_in_part_(parts.size(), -1) {
  const SolidCells all(whole);
  std::vector<int> cells;
  for (int e = 0; e < static_cast<int>(parts.size()); ++e) {
    if (parts[e] != part) continue;
    cell_in_part_[e] = static_cast<int>(cells.size());
    cells.push_back(e);
    for (const int node : all.nodes(e)) number_in_part_[node] = 0;
  }
  for (int node = 0; node < whole.point_count(); ++node)
    if (number_in_part_[node] == 0) {
      number_in_part_[node] = static_cast<int>(part_.nodes.size());
      part_.nodes.push_back(node);
    }
  part_.mesh.points = whole.points(Eigen::all, part_.nodes);
  part_.mesh.blocks = all.blocks_of(cells, number_in_part_);
}

void MeshExtraction::add_volumes() {
  const SolidCells all(whole_), own(part_.mesh);
  for (const auto& [name, group] : whole_.groups) {
    if (group.dimension != 3) continue;
    std::vector<int> cells;
    for (const int cell : all.members(group))
      if (has(cell)) cells.push_back(cell_in_part_[cell]);
    if (!cells.empty()) part_.mesh.groups[name] = own.group_of(cells);
  }
}

void MeshExtraction::add_nodes() {
  for (const auto& [name, group] : whole_.groups) {
    if (group.dimension != 0) continue;
    Group own;
    for (const int node : group.nodes)
      if (number_in_part_[node] >= 0) own.nodes.push_back(number_in_part_[node]);
    if (own.nodes.size() != group.nodes.size()) continue;
    own.weights = group.weights;
    part_.mesh.groups[name] = std::move(own);
  }
}

void MeshExtraction::add_surfaces(const FaceTable& faces, const SurfaceFaces& surfaces, const SurfaceFaces& cuts) {
  const FaceTable own(part_.mesh);
  SurfaceFaces groups;
  const auto add = [&](const std::string& name, int face) {
    Corners corners = faces.corners(face);
    for (int& node : corners) node = number_in_part_[node];
    groups[name].push_back(own.find(corners).value());
  };
  for (const auto& [name, of_group] : surfaces)
    for (const int face : of_group)
      if (has(faces.cell(face))) add(name, face);
  for (const auto& [name, of_cut] : cuts)
    for (const int face : of_cut)
      if (has(faces.cell(face)) || has(faces.other_cell(face))) add(name, face);
  add_surface_cells(groups, own, part_.mesh);
}

}  // namespace bielle::reduce
