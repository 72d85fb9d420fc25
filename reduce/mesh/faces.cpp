#include "reduce/mesh/faces.hpp"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

namespace {

// Nodes of the four sides of a tetrahedron with positive volume, outward: corners, then the mid-side nodes between them
// in gmsh's numbering 4:(0,1) 5:(1,2) 6:(0,2) 7:(0,3) 8:(2,3) 9:(1,3).
constexpr int sides[4][6] = {{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 9, 7}, {0, 3, 2, 7, 8, 6}, {1, 2, 3, 5, 8, 9}};

}  // namespace

FaceTable::FaceTable(const Mesh& mesh) : solids_(mesh.solids()) {
  std::vector<Face> all;
  all.reserve(4 * solids_.nodes.cols());
  for (int cell = 0; cell < solids_.nodes.cols(); ++cell)
    for (int side = 0; side < 4; ++side) {
      std::array<int, 3> key;
      for (int k = 0; k < 3; ++k) key[k] = solids_.nodes(sides[side][k], cell);
      std::sort(key.begin(), key.end());
      all.push_back({key, cell, -1, side});
    }
  std::sort(all.begin(), all.end(),
            [](const Face& a, const Face& b) { return std::tie(a.key, a.cell) < std::tie(b.key, b.cell); });
  for (const Face& face : all) {
    if (faces_.empty() || faces_.back().key != face.key) {
      faces_.push_back(face);
    } else if (faces_.back().other < 0) {
      faces_.back().other = face.cell;
    } else {
      throw InputError(fmt::format("three or more cells share the face at {}: cells overlap or stand twice",
                                   place_name(mesh.points.col(face.key[0]))));
    }
  }
}

CellType FaceTable::type() const { return solids_.type == CellType::tet4 ? CellType::tri3 : CellType::tri6; }

Eigen::VectorXi FaceTable::nodes(int face) const {
  Eigen::VectorXi nodes(node_count(type()));
  for (int k = 0; k < nodes.size(); ++k) nodes[k] = solids_.nodes(sides[faces_[face].side][k], faces_[face].cell);
  return nodes;
}

std::array<int, 3> FaceTable::corners(int face) const {
  const Face& f = faces_[face];
  return {solids_.nodes(sides[f.side][0], f.cell), solids_.nodes(sides[f.side][1], f.cell),
          solids_.nodes(sides[f.side][2], f.cell)};
}

std::optional<int> FaceTable::find(std::array<int, 3> corners) const {
  std::sort(corners.begin(), corners.end());
  const auto found = std::lower_bound(faces_.begin(), faces_.end(), corners,
                                      [](const Face& face, const std::array<int, 3>& key) { return face.key < key; });
  if (found == faces_.end() || found->key != corners) return {};
  return static_cast<int>(found - faces_.begin());
}

std::vector<int> FaceTable::boundary() const {
  std::vector<int> faces;
  for (int face = 0; face < size(); ++face)
    if (on_boundary(face)) faces.push_back(face);
  return faces;
}

}  // namespace bielle::reduce
