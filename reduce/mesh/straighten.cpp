#include "reduce/mesh/straighten.hpp"

#include <vector>

#include "reduce/mesh/jacobian.hpp"

namespace bielle::reduce {

namespace {

// An element counts as inverted below this share of the straight element's determinant. The value is well above
// rounding.
constexpr double least_ratio = 1e-3;

}  // namespace

Straightening straighten_elements(Mesh& mesh) {
  Straightening result;
  const CellBlock& block = mesh.solids();
  const CellInfo& cell = cell_info(block.type);
  if (cell.order == 1) return result;
  std::vector<char> offended(block.nodes.cols(), 0);
  std::vector<char> moved(mesh.points.cols(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (Eigen::Index e = 0; e < block.nodes.cols(); ++e) {
      const auto nodes = block.nodes.col(e);
      const Eigen::Matrix3Xd x = mesh.points(Eigen::all, nodes);
      if (!may_be_inverted(block.type, x, least_ratio)) continue;
      offended[e] = 1;
      const Eigen::Matrix3Xd straight = straight_nodes(block.type, x);
      for (int k = cell.vertices; k < cell.nodes; ++k) {
        if (moved[nodes[k]]) continue;
        const Eigen::Vector3d middle = straight.col(k);
        const double way = (x.col(k) - middle).norm();
        // Nodes that are already in the middle (up to rounding) are neither moved nor counted.
        const auto [a, b] = cell.edges[static_cast<std::size_t>(k - cell.vertices) % cell.edges.size()];
        if (way <= 1e-12 * (x.col(a) - x.col(b)).norm()) continue;
        mesh.points.col(nodes[k]) = middle;
        moved[nodes[k]] = 1;
        changed = true;
        ++result.nodes;
        if (way > result.farthest) {
          result.farthest = way;
          result.place = middle;
        }
      }
    }
  }
  for (char element : offended) result.elements += element;
  return result;
}

}  // namespace bielle::reduce
