#include "reduce/mesh/faces.hpp"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

namespace {

/// The corners in ascending order; the fourth one of a triangle is -1 and stays the last.
std::array<int, 4> key_of(FaceCorners corners) {
  std::sort(corners.begin(), corners.end());
  return {corners[0], corners[1], corners[2], corners[3]};
}

}  // namespace

FaceTable::FaceTable(const Mesh& mesh) : solids_(mesh.solids()) {
  const std::vector<CellFace>& sides = cell_info(solids_.type).faces;
  std::vector<Face> all;
  all.reserve(sides.size() * static_cast<std::size_t>(solids_.nodes.cols()));
  for (int cell = 0; cell < solids_.nodes.cols(); ++cell)
    for (int side = 0; side < static_cast<int>(sides.size()); ++side)
      all.push_back({key_of(corners_of(cell, side)), cell, -1, side});
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

FaceCorners FaceTable::corners_of(int cell, int side) const {
  const CellFace& face = cell_info(solids_.type).faces[static_cast<std::size_t>(side)];
  FaceCorners corners(face.nodes, vertex_count(face.type));
  for (int& node : corners) node = solids_.nodes(node, cell);
  return corners;
}

CellType FaceTable::type(int face) const {
  return cell_info(solids_.type).faces[static_cast<std::size_t>(faces_[face].side)].type;
}

Eigen::VectorXi FaceTable::nodes(int face) const {
  const std::vector<int>& side = cell_info(solids_.type).faces[static_cast<std::size_t>(faces_[face].side)].nodes;
  Eigen::VectorXi nodes(static_cast<Eigen::Index>(side.size()));
  for (Eigen::Index k = 0; k < nodes.size(); ++k)
    nodes[k] = solids_.nodes(side[static_cast<std::size_t>(k)], faces_[face].cell);
  return nodes;
}

FaceCorners FaceTable::corners(int face) const { return corners_of(faces_[face].cell, faces_[face].side); }

std::optional<int> FaceTable::find(const FaceCorners& corners) const {
  const std::array<int, 4> sorted = key_of(corners);
  const auto found = std::lower_bound(faces_.begin(), faces_.end(), sorted,
                                      [](const Face& face, const std::array<int, 4>& key) { return face.key < key; });
  if (found == faces_.end() || found->key != sorted) return {};
  return static_cast<int>(found - faces_.begin());
}

std::vector<int> FaceTable::boundary() const {
  std::vector<int> faces;
  for (int face = 0; face < size(); ++face)
    if (on_boundary(face)) faces.push_back(face);
  return faces;
}

}  // namespace bielle::reduce
