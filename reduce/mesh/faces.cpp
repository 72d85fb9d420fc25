#include "reduce/mesh/faces.hpp"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

FaceTable::FaceTable(const Mesh& mesh) : solids_(mesh.solids()) {
  const std::vector<CellFace>& sides = cell_info(solids_.type).faces;
  std::vector<Face> all;
  all.reserve(sides.size() * solids_.nodes.cols());
  for (int cell = 0; cell < solids_.nodes.cols(); ++cell)
    for (int side = 0; side < static_cast<int>(sides.size()); ++side) {
      Face face{{}, cell, -1, side};
      face.key = corners_in(face).key();
      all.push_back(face);
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

Eigen::VectorXi FaceTable::nodes(int face) const {
  const std::vector<int>& of_side = side_of(faces_[face]).nodes;
  return solids_.nodes(of_side, faces_[face].cell);
}

Corners FaceTable::corners(int face) const { return corners_in(faces_[face]); }

Corners FaceTable::corners_in(const Face& face) const {
  const CellFace& side = side_of(face);
  Corners corners;
  for (int k = 0; k < vertex_count(side.type); ++k) corners.push_back(solids_.nodes(side.nodes[k], face.cell));
  return corners;
}

std::optional<int> FaceTable::find(const Corners& corners) const {
  const std::array<int, 4> key = corners.key();
  const auto found = std::lower_bound(faces_.begin(), faces_.end(), key,
                                      [](const Face& face, const std::array<int, 4>& k) { return face.key < k; });
  if (found == faces_.end() || found->key != key) return {};
  return static_cast<int>(found - faces_.begin());
}

std::vector<int> FaceTable::boundary() const {
  std::vector<int> faces;
  for (int face = 0; face < size(); ++face)
    if (on_boundary(face)) faces.push_back(face);
  return faces;
}

}  // namespace bielle::reduce
