#include "reduce/distributed/partition.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include <Eigen/Geometry>

#include "reduce/mesh/faces.hpp"

namespace bielle::reduce {

namespace {

constexpr double share_of_first = 1.0 / 3;

/// Returns the total share of the parts from `first` to `first + count - 1`, where a full part has the share 1.
double weight(int first, int count) { return first == 0 ? count - 1 + share_of_first : count; }

void divide(const Eigen::Matrix3Xd& centroids, std::span<int> cells, int first_part, int parts,
            std::vector<std::vector<int>>& result) {
  if (parts == 1) {
    result[first_part].assign(cells.begin(), cells.end());
    std::sort(result[first_part].begin(), result[first_part].end());
    return;
  }
  Eigen::AlignedBox3d box;
  for (const int cell : cells) box.extend(Eigen::Vector3d(centroids.col(cell)));
  int axis = 0;
  if (!box.isEmpty()) box.sizes().maxCoeff(&axis);
  const int low = parts / 2;
  const double fraction = weight(first_part, low) / weight(first_part, parts);
  const auto middle = cells.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(cells.size()));
  // Equal places are ordered by the cells' numbers: the same mesh is divided in the same way each time.
  std::nth_element(cells.begin(), middle, cells.end(),
                   [&](int a, int b) { return std::pair(centroids(axis, a), a) < std::pair(centroids(axis, b), b); });
  divide(centroids, {cells.begin(), middle}, first_part, low, result);
  divide(centroids, {middle, cells.end()}, first_part + low, parts - low, result);
}

/// Adds the faces of a coating on some cells.
/// @param cells  ascending @param on  cell of each face @param number  of each point in the share
void add_coating(const Solid& solid, const Coating& coating, const std::vector<int>& cells, const std::vector<int>& on,
                 const std::vector<int>& number, MeshShare& share) {
  Coating own{{coating.faces.dimension, {}, {}}, coating.mass_per_area};
  std::size_t face = 0;
  for (const GroupPart& of_type : coating.faces.parts) {
    std::vector<int> here;
    for (const int column : of_type.cells)
      if (std::binary_search(cells.begin(), cells.end(), on[face++])) here.push_back(column);
    if (here.empty()) continue;
    auto block = std::find_if(share.blocks.begin(), share.blocks.end(),
                              [&](const CellBlock& known) { return known.type == of_type.type; });
    if (block == share.blocks.end())
      block = share.blocks.insert(share.blocks.end(), {of_type.type, Eigen::MatrixXi(node_count(of_type.type), 0)});
    Eigen::MatrixXi nodes = solid.mesh.block(of_type.type)->nodes(Eigen::all, here);
    for (int& node : nodes.reshaped()) node = number[node];
    const Eigen::Index first = block->nodes.cols();
    block->nodes.conservativeResize(Eigen::NoChange, first + nodes.cols());
    block->nodes.rightCols(nodes.cols()) = nodes;
    GroupPart faces{of_type.type, std::vector<int>(here.size())};
    std::iota(faces.cells.begin(), faces.cells.end(), static_cast<int>(first));
    own.faces.parts.push_back(std::move(faces));
  }
  if (!own.faces.parts.empty()) share.coatings.push_back(std::move(own));
}

}  // namespace

std::vector<std::vector<int>> divided_cells(const Solid& solid, int parts) {
  Eigen::Matrix3Xd centroids(3, solid.cells.size());
  for (int e = 0; e < solid.cells.size(); ++e) centroids.col(e) = solid.cells.points(e).rowwise().mean();
  std::vector<int> cells(static_cast<std::size_t>(solid.cells.size()));
  std::iota(cells.begin(), cells.end(), 0);
  std::vector<std::vector<int>> result(static_cast<std::size_t>(parts));
  divide(centroids, cells, 0, parts, result);
  return result;
}

CoatedCells coated_cells(const Solid& solid) {
  CoatedCells result;
  if (solid.coatings.empty()) return result;
  const FaceTable faces(solid.mesh);
  for (const Coating& coating : solid.coatings) {
    result.emplace_back();
    for (const GroupPart& part : coating.faces.parts)
      for (const int face : part.cells) {
        const auto nodes = solid.mesh.block(part.type)->nodes.col(face);
        result.back().push_back(faces.cell(faces.find(corners_of(part.type, nodes)).value()));
      }
  }
  return result;
}

SolidPart part_of(const Solid& solid, const std::vector<int>& cells, const CoatedCells& coated) {
  SolidPart part;
  std::vector<int> number(static_cast<std::size_t>(solid.points()), -1);
  for (const int cell : cells)
    for (const int node : solid.cells.nodes(cell)) number[node] = 0;
  for (std::size_t a = 0; a < number.size(); ++a) {
    if (number[a] < 0) continue;
    number[a] = static_cast<int>(part.points.size());
    part.points.push_back(static_cast<int>(a));
  }
  MeshShare& share = part.share;
  share.integration = solid.integration;
  share.points = solid.mesh.points(Eigen::all, part.points);
  share.blocks = solid.cells.blocks_of(cells, number);
  for (const int cell : cells) share.material_of.push_back(solid.material_of[cell]);
  share.materials = solid.materials;
  share.lumped = solid.lumped;
  for (std::size_t k = 0; k < solid.coatings.size(); ++k)
    add_coating(solid, solid.coatings[k], cells, coated[k], number, share);
  return part;
}

}  // namespace bielle::reduce
