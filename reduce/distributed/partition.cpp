#include "reduce/distributed/partition.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include <Eigen/Geometry>

namespace bielle::reduce {

namespace {

constexpr double share_of_first = 1.0 / 3;

/// Total share of the parts from `first` to `first + count - 1`, where a full part has the share 1.
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

SolidPart part_of(const Solid& solid, const std::vector<int>& cells) {
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
  for (const Material& material : solid.materials) {
    share.elasticities.push_back(material.elasticity);
    share.densities.push_back(material.density);
  }
  return part;
}

}  // namespace bielle::reduce
