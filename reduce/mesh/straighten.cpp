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
  const CellBlock* block = mesh.block(CellType::tet10);
  if (block == nullptr) return result;
  std::vector<char> offended(block->nodes.cols(), 0);
  std::vector<char> moved(mesh.points.cols(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (Eigen::Index e = 0; e < block->nodes.cols(); ++e) {
      const auto nodes = block->nodes.col(e);
      const Eigen::Matrix3Xd x = mesh.points(Eigen::all, nodes);
      if (determinant_coefficients(x).minCoeff() > least_ratio * straight_determinant(x)) continue;
      offended[e] = 1;
      for (int k = 0; k < 6; ++k) {
        if (moved[nodes[4 + k]]) continue;
        const Eigen::Vector3d middle = 0.5 * (x.col(tet_edges[k][0]) + x.col(tet_edges[k][1]));
        const double way = (x.col(4 + k) - middle).norm();
        // Nodes that are already in the middle (up to rounding) are neither moved nor counted.
        if (way <= 1e-12 * (x.col(tet_edges[k][0]) - x.col(tet_edges[k][1])).norm()) continue;
        mesh.points.col(nodes[4 + k]) = middle;
        moved[nodes[4 + k]] = 1;
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
