#include "reduce/mesh/overlaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/mesh/disjoint_sets.hpp"
#include "reduce/mesh/jacobian.hpp"
#include "reduce/mesh/place.hpp"
#include "reduce/mesh/solid_cells.hpp"

namespace bielle::reduce {

namespace {

std::size_t number_of(int cell, const std::vector<std::size_t>& cell_tags) {
  return cell_tags.empty() ? static_cast<std::size_t>(cell) + 1 : cell_tags[static_cast<std::size_t>(cell)];
}

Eigen::Vector3d centroid(const SolidCells& cells, int cell) { return cells.corner_points(cell).rowwise().mean(); }

// "elements 3 and 12 at (..) m", in the order of the file.
std::string pair_name(const SolidCells& cells, int one, int other, const std::vector<std::size_t>& cell_tags) {
  const auto [first, second] = std::minmax({number_of(one, cell_tags), number_of(other, cell_tags)});
  return fmt::format("elements {} and {} at {}", first, second, place_name(centroid(cells, one)));
}

// Cells whose corners an earlier cell has, and the first of them with that cell.
struct Repeated {
  int count = 0;
  std::pair<int, int> first{-1, -1};
};

// @param node_number  (node) -> number, the same for nodes that count as one
template <class Number>
Repeated repeated_cells(const SolidCells& cells, const Number& node_number) {
  using Key = std::array<int, 8>;  // sorted corners; -1 in front of fewer than eight
  std::vector<std::pair<Key, int>> sorted;
  sorted.reserve(static_cast<std::size_t>(cells.size()));
  for (int e = 0; e < cells.size(); ++e) {
    Key key;
    key.fill(-1);
    std::size_t k = 0;
    for (const int node : cells.vertices(e)) key[k++] = node_number(node);
    std::sort(key.begin(), key.end());
    sorted.emplace_back(key, e);
  }
  std::sort(sorted.begin(), sorted.end());
  Repeated repeated;
  std::size_t begin = 0;  // place of the first of equal keys
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    if (sorted[k].first != sorted[begin].first) {
      begin = k;
      continue;
    }
    ++repeated.count;
    const std::pair<int, int> pair(sorted[begin].second, sorted[k].second);
    if (repeated.count == 1 || pair < repeated.first) repeated.first = pair;
  }
  return repeated;
}

// Tells whether a place lies inside a cell, deeper than a thousandth of its size. A quadrilateral face counts as the
// plane through its middle.
bool is_inside(const SolidCells& cells, int cell, const Eigen::Matrix3Xd& corners, const Eigen::Vector3d& place) {
  for (const CellFace& face : cell_info(straight_type(cells.type(cell))).faces) {
    const Eigen::Matrix3Xd x = corners(Eigen::all, face.nodes);
    const Eigen::Index last = x.cols() - 1;
    const Eigen::Vector3d outward = (x.col(2) - x.col(0)).cross(x.col(last) - x.col(1)),
                          from_face = place - x.rowwise().mean();
    const double area = outward.norm();
    if (outward.dot(from_face) > -1e-3 * area * std::sqrt(area)) return false;
  }
  return true;
}

// A cell that holds the centroid of a cell of another piece, and that cell.
std::optional<std::pair<int, int>> overlapping_cells(const SolidCells& cells, const std::vector<int>& piece_of) {
  constexpr std::size_t most = 1000;  // centroids looked up
  std::map<int, Eigen::AlignedBox3d> boxes;
  for (int e = 0; e < cells.size(); ++e) {
    const Eigen::Matrix3Xd corners = cells.corner_points(e);
    Eigen::AlignedBox3d& box = boxes[piece_of[static_cast<std::size_t>(e)]];
    for (Eigen::Index k = 0; k < corners.cols(); ++k) box.extend(corners.col(k));
  }
  constexpr std::size_t few = 100;
  // So many pieces occur if the nodes of a whole mesh are not merged.
  if (boxes.size() > few) return {};
  std::vector<std::pair<int, Eigen::Vector3d>> candidates;  // cells with their centroids in the box of another piece
  for (int e = 0; e < cells.size(); ++e) {
    const Eigen::Vector3d middle = centroid(cells, e);
    if (std::any_of(boxes.begin(), boxes.end(), [&](const auto& box) {
          return box.first != piece_of[static_cast<std::size_t>(e)] && box.second.contains(middle);
        }))
      candidates.emplace_back(e, middle);
  }
  const std::size_t step = candidates.size() / most + 1;
  for (int e = 0; e < cells.size(); ++e) {
    const Eigen::Matrix3Xd corners = cells.corner_points(e);
    const Eigen::AlignedBox3d box(Eigen::Vector3d(corners.rowwise().minCoeff()),
                                  Eigen::Vector3d(corners.rowwise().maxCoeff()));
    for (std::size_t k = 0; k < candidates.size(); k += step) {
      const auto& [other, middle] = candidates[k];
      if (piece_of[static_cast<std::size_t>(other)] != piece_of[static_cast<std::size_t>(e)] && box.contains(middle) &&
          is_inside(cells, e, corners, middle))
        return std::pair(e, other);
    }
  }
  return {};
}

}  // namespace

void check_repeated_cells(const Mesh& mesh, const std::vector<std::size_t>& cell_tags) {
  const SolidCells cells(mesh);
  const Repeated repeated = repeated_cells(cells, [](int node) { return node; });
  if (repeated.count == 0) return;
  const char* part = repeated.count == 1                  ? "this cell is"
                     : 2 * repeated.count == cells.size() ? "the whole mesh is"
                                                          : "a part of the mesh is";
  throw InputError(
      fmt::format("{} of {} elements {} the same corners as another one (the first: {}): {} in the file more than "
                  "once; keep one of "
                  "each",
                  repeated.count, cells.size(), repeated.count == 1 ? "has" : "have",
                  pair_name(cells, repeated.first.first, repeated.first.second, cell_tags), part));
}

void check_sides_of_faces(const Mesh& mesh, const FaceTable& faces, const std::vector<std::size_t>& cell_tags) {
  const SolidCells cells(mesh);
  int count = 0, first = -1;
  for (int face = faces.size() - 1; face >= 0; --face)
    if (!faces.on_boundary(face) && faces.on_one_side(face)) {
      ++count;
      first = face;
    }
  if (count == 0) return;
  throw InputError(
      fmt::format("{} {} both cells on the same side: cells overlap, the first are {}; remove the cells that are too "
                  "many",
                  counted(count, "common face"), count == 1 ? "has" : "have",
                  pair_name(cells, faces.cell(first), faces.other_cell(first), cell_tags)));
}

std::string overlap_of_pieces(const Mesh& mesh, const std::vector<int>& piece_of,
                              const std::vector<std::pair<int, int>>& node_pairs,
                              const std::vector<std::size_t>& cell_tags) {
  const SolidCells cells(mesh);
  DisjointSets places(static_cast<int>(mesh.point_count()));
  for (const auto& [node, other] : node_pairs) places.join(node, other);
  const Repeated repeated = repeated_cells(cells, [&](int node) { return places.of(node); });
  if (repeated.count > 0)
    return fmt::format(
        "{} of {} elements {} on another one with nodes of {} own (the first: {}): the mesh, or a part of it, is in "
        "the "
        "file more than once; keep one of each",
        repeated.count, cells.size(), repeated.count == 1 ? "lies" : "lie", repeated.count == 1 ? "its" : "their",
        pair_name(cells, repeated.first.first, repeated.first.second, cell_tags));
  if (const auto pair = overlapping_cells(cells, piece_of))
    return fmt::format("the pieces overlap, {} for example: remove one piece, or cut one by the other before meshing",
                       pair_name(cells, pair->second, pair->first, cell_tags));
  return "";
}

}  // namespace bielle::reduce
