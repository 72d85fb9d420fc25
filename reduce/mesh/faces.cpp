#include "reduce/mesh/faces.hpp"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

FaceTable::FaceTable(const Mesh& mesh) : cells_(mesh) {
  std::vector<Face> all;
  std::size_t count = 0;
  for (const SolidCells::Range& range : cells_.ranges()) count += cell_info(range.type).faces.size() * range.count;
  all.reserve(count);
  for (int cell = 0; cell < cells_.size(); ++cell)
    for (int side = 0; side < static_cast<int>(cell_info(cells_.type(cell)).faces.size()); ++side)
      all.push_back({corners_in(cell, side).key(), cell, -1, side, -1});
  std::sort(all.begin(), all.end(),
            [](const Face& a, const Face& b) { return std::tie(a.key, a.cell) < std::tie(b.key, b.cell); });
  for (const Face& face : all) {
    if (faces_.empty() || faces_.back().key != face.key) {
      faces_.push_back(face);
    } else if (faces_.back().other < 0) {
      faces_.back().other = face.cell;
      faces_.back().other_side = face.side;
    } else {
      throw InputError(fmt::format("three or more cells share the face at {}: cells overlap",
                                   place_name(mesh.points.col(face.key[0]))));
    }
  }
}

Eigen::VectorXi FaceTable::nodes(int face) const {
  const Face& of = faces_[face];
  return cells_.nodes(of.cell)(side_of(of.cell, of.side).nodes);
}

bool FaceTable::same_on_both_sides(int face) const {
  const Face& of = faces_[face];
  const std::vector<int>&one = side_of(of.cell, of.side).nodes, &other = side_of(of.other, of.other_side).nodes;
  if (one.size() != other.size()) return false;
  const auto nodes = cells_.nodes(of.cell), of_other = cells_.nodes(of.other);
  return std::all_of(one.begin(), one.end(), [&](int a) {
    return std::any_of(other.begin(), other.end(), [&](int b) { return nodes(a) == of_other(b); });
  });
}

bool FaceTable::on_one_side(int face) const {
  const Face& of = faces_[face];
  const Corners one = corners_in(of.cell, of.side), other = corners_in(of.other, of.other_side);
  const int at = static_cast<int>(std::find(other.begin(), other.end(), one[0]) - other.begin());
  return other[(at + 1) % other.size()] == one[1];
}

Corners FaceTable::corners(int face) const { return corners_in(faces_[face].cell, faces_[face].side); }

Corners FaceTable::corners_in(int cell, int side) const {
  const CellFace& of_cell = side_of(cell, side);
  const auto nodes = cells_.nodes(cell);
  Corners corners;
  for (int k = 0; k < vertex_count(of_cell.type); ++k) corners.push_back(nodes(of_cell.nodes[k]));
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
