#include "reduce/mesh/straighten.hpp"

#include <utility>
#include <vector>

#include "reduce/mesh/cell_type.hpp"
#include "reduce/mesh/jacobian.hpp"
#include "reduce/mesh/measures.hpp"
#include "reduce/mesh/solid_cells.hpp"

namespace bielle::reduce {

namespace {

// An element counts as inverted below this share of the straight element's determinant. The value is well above
// rounding.
constexpr double least_ratio = 1e-3;

// Nodes of a cell that are no vertices, and the vertices of the edge, face or cell in the middle of which they lie.
std::vector<std::pair<int, std::vector<int>>> middle_nodes(const CellInfo& cell) {
  std::vector<std::pair<int, std::vector<int>>> result;
  int node = cell.vertices;
  for (const auto& [a, b] : cell.edges) result.emplace_back(node++, std::vector<int>{a, b});
  if (cell.type != CellType::hex27) return result;
  for (const CellFace& face : cell.faces)
    result.emplace_back(face.nodes.back(), std::vector<int>(face.nodes.begin(), face.nodes.begin() + 4));
  result.emplace_back(cell.nodes - 1, std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7});
  return result;
}

}  // namespace

Straightening straighten_elements(Mesh& mesh) {
  Straightening result;
  Eigen::Matrix3Xd before = mesh.points;
  const SolidCells cells(mesh);
  std::vector<char> offended(cells.size(), 0);
  std::vector<char> moved(mesh.points.cols(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (const SolidCells::Range& range : cells.ranges()) {
      const CellInfo& info = cell_info(range.type);
      if (info.order == 1) continue;
      const CellType straight = straight_type(range.type);
      const auto middles = middle_nodes(info);
      for (int e = range.first; e < range.first + range.count; ++e) {
        const auto nodes = cells.nodes(e);
        const Eigen::Matrix3Xd x = cells.points(e);
        if (checked_determinants(range.type, x).minCoeff() > least_ratio * checked_determinants(straight, x).minCoeff())
          continue;
        offended[e] = 1;
        for (const auto& [node, ends] : middles) {
          if (moved[nodes[node]]) continue;
          Eigen::Vector3d middle = Eigen::Vector3d::Zero();
          for (const int end : ends) middle += x.col(end);
          middle /= static_cast<double>(ends.size());
          const double way = (x.col(node) - middle).norm();
          // Nodes that are already in the middle (up to rounding) are neither moved nor counted.
          if (way <= 1e-12 * (x.col(ends.front()) - x.col(ends.back())).norm()) continue;
          mesh.points.col(nodes[node]) = middle;
          moved[nodes[node]] = 1;
          changed = true;
          ++result.nodes;
          if (way > result.farthest) {
            result.farthest = way;
            result.place = middle;
          }
        }
      }
    }
  }
  for (char element : offended) result.elements += element;
  if (result.nodes == 0) return result;
  const double after = mesh_volume(mesh);
  std::swap(mesh.points, before);
  result.volume_change = after / mesh_volume(mesh) - 1;
  std::swap(mesh.points, before);
  return result;
}

}  // namespace bielle::reduce
