#include "reduce/mesh/checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/mesh/disjoint_sets.hpp"
#include "reduce/mesh/jacobian.hpp"
#include "reduce/mesh/overlaps.hpp"
#include "reduce/mesh/place.hpp"
#include "reduce/mesh/solid_cells.hpp"
#include "reduce/mesh/sorted_points.hpp"

namespace bielle::reduce {

namespace {

double longest_edge(const CellInfo& cell, const Eigen::Matrix3Xd& x) {
  double longest = 0;
  for (const auto& edge : cell.edges) longest = std::max(longest, (x.col(edge[0]) - x.col(edge[1])).norm());
  return longest;
}

struct Piece {
  int cells = 0;
  double volume = 0;  // [m^3]
  Eigen::AlignedBox3d box;
};

// Sorts the solid cells by the number that `number_of` gives them; the largest piece comes first.
template <class Number>
std::vector<Piece> pieces_of(const Mesh& mesh, const Number& number_of) {
  const SolidCells cells(mesh);
  std::map<int, Piece> numbered;
  for (int e = 0; e < cells.size(); ++e) {
    Piece& piece = numbered[number_of(e)];
    const Eigen::Matrix3Xd x = cells.corner_points(e);
    ++piece.cells;
    piece.volume += cell_volume(straight_type(cells.type(e)), x);
    for (const auto& vertex : x.colwise()) piece.box.extend(Eigen::Vector3d(vertex));
  }
  std::vector<Piece> pieces;
  for (const auto& [number, piece] : numbered) pieces.push_back(piece);
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.volume > b.volume; });
  return pieces;
}

// "12 elements with 1.3 m^3 from (..) to (..); ... and 3 more"
std::string piece_names(const std::vector<Piece>& pieces) {
  constexpr std::size_t most = 5;
  std::string names;
  for (std::size_t i = 0; i < std::min(pieces.size(), most); ++i)
    names += fmt::format("{}{} with {:.3g} m^3 from {} to {}", i == 0 ? "" : "; ", counted(pieces[i].cells, "element"),
                         pieces[i].volume, place_name(pieces[i].box.min()), place_name(pieces[i].box.max()));
  if (pieces.size() > most) names += fmt::format("; and {} more", pieces.size() - most);
  return names;
}

// Pairs of the listed points nearer to each other than `distance`; a point is the first of one pair at most.
std::vector<std::pair<int, int>> near_pairs(const Eigen::Matrix3Xd& points, const std::vector<int>& listed,
                                            double distance) {
  const SortedPoints sorted(points, listed);
  std::vector<std::pair<int, int>> pairs;
  for (const int node : listed) {
    int partner = -1;
    const auto is_later = [&](int other) { return partner = other, other > node; };
    if (sorted.has_near(points.col(node), distance, is_later)) pairs.emplace_back(node, partner);
  }
  return pairs;
}

}  // namespace

void check_elements(const Mesh& mesh, const std::vector<std::size_t>& cell_tags) {
  const SolidCells cells(mesh);
  int inverted = 0, mirrored = 0, flat = 0;
  int first_inverted = 0, first_flat = 0;
  for (int e = cells.size() - 1; e >= 0; --e) {
    const Eigen::Matrix3Xd x = cells.corner_points(e);
    const Eigen::VectorXd determinants = checked_determinants(straight_type(cells.type(e)), x);
    const double least = determinants.minCoeff(),
                 negligible = 1e-12 * std::pow(longest_edge(cell_info(cells.type(e)), x), 3);
    if (std::abs(least) <= negligible) {
      ++flat;
      first_flat = e;
    } else if (least < 0) {
      ++inverted;
      mirrored += determinants.maxCoeff() < 0;
      first_inverted = e;
    }
  }
  const auto named = [&](int e) {
    const std::size_t number = cell_tags.empty() ? static_cast<std::size_t>(e) + 1 : cell_tags[e];
    return fmt::format("element {} at {}", number, place_name(cells.corner_points(e).rowwise().mean()));
  };
  // The determinant of a tetrahedron is constant; other cells may be folded in a part of them only.
  const bool constant = std::all_of(cells.ranges().begin(), cells.ranges().end(),
                                    [](const SolidCells::Range& range) { return range.vertices == 4; });
  if (mirrored == cells.size())
    throw InputError(fmt::format(
        "every element is inverted (negative volume): the mesh is mirrored, or its nodes are ordered otherwise; "
        "the first is {}",
        named(first_inverted)));
  if (inverted > 0)
    throw InputError(fmt::format("{} of {} elements {} inverted (negative volume{}); the first is {}", inverted,
                                 cells.size(), inverted == 1 ? "is" : "are", constant ? "" : ", or folded at a corner",
                                 named(first_inverted)));
  if (flat > 0)
    throw InputError(fmt::format("{} of {} elements {} degenerate (no volume{}); the first is {}", flat, cells.size(),
                                 flat == 1 ? "is" : "are", constant ? "" : ", or a flat or collapsed corner",
                                 named(first_flat)));
}

void check_connected(const Mesh& mesh, const std::vector<std::size_t>& cell_tags) {
  const SolidCells cells(mesh);
  DisjointSets nodes(static_cast<int>(mesh.point_count()));
  for (int e = 0; e < cells.size(); ++e)
    for (const int node : cells.nodes(e)) nodes.join(cells.nodes(e)(0), node);
  std::vector<int> piece_of(static_cast<std::size_t>(cells.size()));
  for (int e = 0; e < cells.size(); ++e) piece_of[static_cast<std::size_t>(e)] = nodes.of(cells.nodes(e)(0));
  const std::vector<Piece> pieces = pieces_of(mesh, [&](int cell) { return piece_of[static_cast<std::size_t>(cell)]; });
  if (pieces.size() == 1) return;

  std::vector<int> all(mesh.point_count());
  std::iota(all.begin(), all.end(), 0);
  const std::vector<std::pair<int, int>> pairs = near_pairs(mesh.points, all, 1e-6 * mesh_quality(mesh).shortest_edge);
  const auto touching = std::count_if(pairs.begin(), pairs.end(),
                                      [&](const auto& pair) { return nodes.of(pair.first) != nodes.of(pair.second); });
  std::string advice = overlap_of_pieces(mesh, piece_of, pairs, cell_tags);
  if (advice.empty())
    advice = touching > 0 ? fmt::format("{} at the same place: merge the nodes",
                                        counted(touching, "pair of nodes", "pairs of nodes"))
                          : "join them in the geometry (a fragment or union), or reduce each by itself";
  throw InputError(
      fmt::format("the body is in {} pieces that share no nodes: {}; {}", pieces.size(), piece_names(pieces), advice));
}

std::string loose_joints(const Mesh& mesh, const FaceTable& faces, const std::vector<std::size_t>& cell_tags) {
  DisjointSets cells(static_cast<int>(mesh.solid_count()));
  for (int face = 0; face < faces.size(); ++face)
    if (!faces.on_boundary(face)) cells.join(faces.cell(face), faces.other_cell(face));
  const std::vector<Piece> pieces = pieces_of(mesh, [&](int cell) { return cells.of(cell); });
  if (pieces.size() == 1) return "";
  std::vector<int> piece_of(static_cast<std::size_t>(mesh.solid_count()));
  for (int e = 0; e < static_cast<int>(piece_of.size()); ++e) piece_of[static_cast<std::size_t>(e)] = cells.of(e);
  if (const std::string overlap = overlap_of_pieces(mesh, piece_of, {}, cell_tags); !overlap.empty())
    throw InputError(fmt::format("the body is in {} pieces that share no faces: {}; {}", pieces.size(),
                                 piece_names(pieces), overlap));
  return fmt::format("{} parts of the body are connected by single nodes or edges only, about which they can turn: {}",
                     pieces.size(), piece_names(pieces));
}

CoincidentNodes coincident_nodes(const Mesh& mesh, const FaceTable& faces) {
  std::vector<char> on_boundary(mesh.point_count(), 0);
  for (int face : faces.boundary())
    for (int node : faces.nodes(face)) on_boundary[node] = 1;
  std::vector<int> listed;
  for (int node = 0; node < mesh.point_count(); ++node)
    if (on_boundary[node]) listed.push_back(node);
  const auto pairs = near_pairs(mesh.points, listed, 1e-6 * mesh_quality(mesh).shortest_edge);
  CoincidentNodes result;
  result.pairs = static_cast<int>(pairs.size());
  if (!pairs.empty()) result.place = mesh.points.col(pairs.front().first);
  return result;
}

std::string stiff_wedges(const Mesh& mesh, const FaceTable& faces) {
  const SolidCells cells(mesh);
  std::map<int, int> free_triangles;  // wedge -> its triangles on the surface
  for (const int face : faces.boundary())
    if (const int cell = faces.cell(face); cells.type(cell) == CellType::wedge6 && faces.type(face) == CellType::tri3)
      ++free_triangles[cell];
  const auto single =
      std::count_if(free_triangles.begin(), free_triangles.end(), [](const auto& wedge) { return wedge.second == 2; });
  for (const SolidCells::Range& range : cells.ranges())
    if (range.type == CellType::wedge6)
      return fmt::format("{} of {} elements {} wedge6{}, which {} far too stiff in bending: use wedge15, or hexahedra",
                         range.count, cells.size(), range.count == 1 ? "is a" : "are",
                         single > 0 ? fmt::format(" ({} as the only layer between two surfaces)", single) : "",
                         range.count == 1 ? "is" : "are");
  return "";
}

std::string implausible_size(const Mesh& mesh) {
  return implausible_length((mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).maxCoeff());
}

std::string implausible_length(double metres) {
  if (metres <= 150 && metres >= 1e-3) return "";
  return fmt::format("the body is {:.3g} m long: is length_unit right?", metres);
}

MeshQuality mesh_quality(const Mesh& mesh) {
  const SolidCells cells(mesh);
  MeshQuality quality;
  quality.shortest_edge = quality.least_scaled_jacobian = std::numeric_limits<double>::infinity();
  for (int e = 0; e < cells.size(); ++e) {
    const Eigen::Matrix3Xd x = cells.corner_points(e);
    for (const auto& edge : cell_info(cells.type(e)).edges) {
      const double length = (x.col(edge[0]) - x.col(edge[1])).norm();
      quality.shortest_edge = std::min(quality.shortest_edge, length);
      quality.longest_edge = std::max(quality.longest_edge, length);
    }
    const double scaled = scaled_jacobian(cells.type(e), x);
    if (scaled < quality.least_scaled_jacobian) {
      quality.least_scaled_jacobian = scaled;
      quality.worst_place = x.rowwise().mean();
    }
  }
  return quality;
}

std::string summary(const Mesh& mesh) {
  const MeshQuality quality = mesh_quality(mesh);
  const SolidCells cells(mesh);
  std::vector<std::string> counts;
  for (const SolidCells::Range& range : cells.ranges())
    counts.push_back(fmt::format("{} {}", range.count, cell_name(range.type)));
  return fmt::format("{}, {}, edges from {} to {}, least scaled Jacobian {:.2g} at {}",
                     counted(mesh.point_count(), "node"), fmt::join(counts, ", "), length_name(quality.shortest_edge),
                     length_name(quality.longest_edge), quality.least_scaled_jacobian, place_name(quality.worst_place));
}

}  // namespace bielle::reduce
