#include "reduce/mesh/cut_mesh.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/mesh/disjoint_sets.hpp"
#include "reduce/mesh/faces.hpp"
#include "reduce/mesh/mesh_part.hpp"
#include "reduce/mesh/place.hpp"

namespace bielle::reduce {

namespace {

using PlaneSides = std::vector<bool>;  // for each plane, whether a cell is on the side of its normal

std::vector<PlaneSides> sides_of_cells(const Mesh& mesh, const std::vector<CutPlane>& planes) {
  const SolidCells cells(mesh);
  std::vector<PlaneSides> sides;
  for (int e = 0; e < cells.size(); ++e) {
    const Eigen::Vector3d centroid = cells.corner_points(e).rowwise().mean();
    PlaneSides of_cell;
    for (const CutPlane& plane : planes) of_cell.push_back(plane.normal.dot(centroid - plane.point) > 0);
    sides.push_back(of_cell);
  }
  return sides;
}

// Number of the piece of each cell, from 0: a piece consists of cells on the same sides that are connected by nodes.
std::vector<int> connected_pieces(const Mesh& mesh, const std::vector<PlaneSides>& sides) {
  const SolidCells cells(mesh);
  const int count = cells.size();
  DisjointSets sets(count);
  std::map<PlaneSides, std::vector<int>> first_cells;  // first cells of each node, by their sides
  for (int e = 0; e < count; ++e) {
    std::vector<int>& first = first_cells.try_emplace(sides[e], mesh.point_count(), -1).first->second;
    for (const int node : cells.vertices(e)) {
      int& cell = first[node];
      if (cell < 0) cell = e;
      sets.join(e, cell);
    }
  }
  std::map<int, int> numbers;
  std::vector<int> pieces;
  for (int e = 0; e < count; ++e) pieces.push_back(numbers.try_emplace(sets.of(e), numbers.size()).first->second);
  return pieces;
}

// Cells that cross a plane near its rim may be isolated on their side: a set of cells all of whose corners also belong
// to one neighbour is no piece and is joined to that neighbour.
void join_islands(const Mesh& mesh, std::vector<int>& pieces) {
  const SolidCells cells(mesh);
  std::vector<std::set<int>> at_node(mesh.point_count());
  for (int e = 0; e < cells.size(); ++e)
    for (const int node : cells.vertices(e)) at_node[node].insert(pieces[e]);
  std::map<int, std::set<int>> around;  // piece -> those that have all its corners
  for (const std::set<int>& here : at_node)
    for (const int piece : here) {
      const auto [place, is_new] = around.try_emplace(piece, here);
      if (!is_new) std::erase_if(place->second, [&](int other) { return !here.contains(other); });
    }
  std::map<int, int> owner;
  for (const auto& [piece, others] : around)
    for (const int other : others)
      if (other != piece && !around.at(other).contains(piece)) owner[piece] = other;
  for (int& piece : pieces)
    while (owner.contains(piece)) piece = owner.at(piece);
}

// A face between two pieces.
struct CutFace {
  std::size_t plane;
  std::array<int, 2> pieces;
  int face;
};

// The plane between two cells of different pieces. @throws InputError when there are several
std::size_t plane_between(const Mesh& mesh, const std::array<int, 2>& cells, const std::array<PlaneSides, 2>& sides,
                          const std::vector<CutPlane>& planes) {
  std::vector<std::size_t> between;
  for (std::size_t k = 0; k < planes.size(); ++k)
    if (sides[0][k] != sides[1][k]) between.push_back(k);
  if (between.size() == 1) return between.front();
  throw InputError(
      planes[between.at(1)].subject,
      fmt::format("'{}' and '{}' meet in the body, or are less than an element apart, near {}: planes must leave "
                  "elements between them, and must not cross within the body",
                  planes[between[0]].name, planes[between[1]].name,
                  place_name(mesh.points.col(SolidCells(mesh).nodes(cells[0])(0)))));
}

// Sides of each piece: the sides of most of its cells, since isolated cells of other sides may have been joined.
std::map<int, PlaneSides> sides_of_pieces(const std::vector<PlaneSides>& sides, const std::vector<int>& pieces) {
  std::map<int, std::map<PlaneSides, int>> votes;
  for (std::size_t e = 0; e < sides.size(); ++e) ++votes[pieces[e]][sides[e]];
  std::map<int, PlaneSides> result;
  for (const auto& [piece, of_piece] : votes)
    result[piece] = std::max_element(of_piece.begin(), of_piece.end(), [](const auto& a, const auto& b) {
                      return a.second < b.second;
                    })->first;
  return result;
}

std::vector<CutFace> faces_between(const Mesh& mesh, const FaceTable& faces, const std::vector<PlaneSides>& sides,
                                   const std::vector<int>& pieces, const std::vector<CutPlane>& planes) {
  const std::map<int, PlaneSides> of_piece = sides_of_pieces(sides, pieces);
  std::vector<CutFace> result;
  for (int face = 0; face < faces.size(); ++face) {
    if (faces.on_boundary(face)) continue;
    const std::array<int, 2> cells{faces.cell(face), faces.other_cell(face)};
    const int a = pieces[cells[0]], b = pieces[cells[1]];
    if (a == b) continue;
    const std::size_t plane = plane_between(mesh, cells, {of_piece.at(a), of_piece.at(b)}, planes);
    result.push_back({plane, {std::min(a, b), std::max(a, b)}, face});
  }
  return result;
}

// Numbers the pieces anew, starting from the piece of the first cell, neighbours in the order of the planes.
std::vector<int> order_of_pieces(const std::vector<CutFace>& between, int start, int count) {
  std::vector<std::set<std::tuple<std::size_t, int>>> neighbours(count);
  for (const CutFace& cut : between) {
    neighbours[cut.pieces[0]].emplace(cut.plane, cut.pieces[1]);
    neighbours[cut.pieces[1]].emplace(cut.plane, cut.pieces[0]);
  }
  std::vector<int> number(count, -1), queue{start};
  number[start] = 0;
  for (std::size_t k = 0; k < queue.size(); ++k)
    for (const auto& [plane, other] : neighbours[queue[k]])
      if (number[other] < 0) {
        number[other] = static_cast<int>(queue.size());
        queue.push_back(other);
      }
  if (static_cast<int>(queue.size()) < count)
    throw InputError("the body falls apart at a cut: there it is connected by single nodes or edges only");
  return number;
}

// Renumbers without gaps. @returns the number of pieces
int renumber(std::vector<int>& pieces) {
  std::map<int, int> numbers;
  for (int& piece : pieces) piece = numbers.try_emplace(piece, numbers.size()).first->second;
  return static_cast<int>(numbers.size());
}

// A cell with a node; the first one if there is none.
int cell_with(const Mesh& mesh, int node) {
  const SolidCells cells(mesh);
  for (int cell = 0; cell < cells.size(); ++cell)
    if ((cells.nodes(cell).array() == node).any()) return cell;
  return 0;
}

// A cell at a group of surfaces or nodes.
int cell_at(const Mesh& mesh, const FaceTable& faces, const std::string& group) {
  const auto found = mesh.groups.find(group);
  if (found == mesh.groups.end()) return 0;
  if (found->second.dimension == 0) return cell_with(mesh, found->second.nodes.front());
  if (found->second.parts.empty()) return 0;
  const GroupPart& part = found->second.parts.front();
  const Eigen::MatrixXi& nodes = mesh.block(part.type)->nodes;
  const auto face = faces.find(corners_of(part.type, nodes.col(part.cells[0])));
  return face ? faces.cell(*face) : 0;
}

void check_planes_cut(const Mesh& mesh, const std::vector<CutFace>& between, const std::vector<CutPlane>& planes) {
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (std::any_of(between.begin(), between.end(), [&](const CutFace& face) { return face.plane == k; })) continue;
    const Eigen::RowVectorXd height = planes[k].normal.transpose() * (mesh.points.colwise() - planes[k].point);
    throw InputError(
        planes[k].subject,
        fmt::format("'{}' does not cut the body, which lies between {:.6g} m and {:.6g} m from the plane along its "
                    "normal {}",
                    planes[k].name, height.minCoeff(), height.maxCoeff(), direction_name(planes[k].normal)));
  }
}

// Connected surfaces of one plane between two pieces, with their faces in the whole mesh.
struct CutSurfaces {
  std::vector<MeshCut> cuts;
  std::vector<std::vector<int>> faces;  // faces of each cut
};

double farthest_corner(const Mesh& mesh, const FaceTable& faces, const std::vector<int>& of_cut,
                       const CutPlane& plane) {
  double distance = 0;
  for (const int face : of_cut)
    for (const int node : faces.corners(face))
      distance = std::max(distance, std::abs(plane.normal.dot(mesh.points.col(node) - plane.point)));
  return distance;
}

CutSurfaces connected_cuts(const Mesh& mesh, const FaceTable& faces, std::vector<CutFace> between,
                           const std::vector<CutPlane>& planes) {
  std::stable_sort(between.begin(), between.end(), [](const CutFace& a, const CutFace& b) {
    return std::tie(a.plane, a.pieces) < std::tie(b.plane, b.pieces);
  });
  DisjointSets sets(static_cast<int>(between.size()));
  std::map<std::tuple<std::size_t, std::array<int, 2>, int>, int> first;  // plane, pieces, node -> face
  for (int i = 0; i < static_cast<int>(between.size()); ++i)
    for (const int node : faces.corners(between[i].face))
      sets.join(i, first.try_emplace({between[i].plane, between[i].pieces, node}, i).first->second);
  std::map<int, std::size_t> number;
  CutSurfaces result;
  for (int i = 0; i < static_cast<int>(between.size()); ++i) {
    const auto [place, is_new] = number.try_emplace(sets.of(i), result.cuts.size());
    if (is_new) {
      result.cuts.push_back({"", "", between[i].plane, between[i].pieces});
      result.faces.emplace_back();
    }
    result.faces[place->second].push_back(between[i].face);
  }
  std::map<std::size_t, int> places, named;
  for (const MeshCut& cut : result.cuts) ++places[cut.plane];
  for (std::size_t k = 0; k < result.cuts.size(); ++k) {
    MeshCut& cut = result.cuts[k];
    const CutPlane& plane = planes[cut.plane];
    cut.name = places[cut.plane] == 1 ? plane.name : fmt::format("{}_{}", plane.name, ++named[cut.plane]);
    cut.group = "pieces." + cut.name;
    cut.distance = farthest_corner(mesh, faces, result.faces[k], plane);
  }
  return result;
}

}  // namespace

CutMesh cut_mesh(const Mesh& mesh, const std::vector<CutPlane>& planes, const std::string& first) {
  const FaceTable faces(mesh);
  const std::vector<PlaneSides> sides = sides_of_cells(mesh, planes);
  std::vector<int> pieces = connected_pieces(mesh, sides);
  join_islands(mesh, pieces);
  const int count = renumber(pieces);
  std::vector<CutFace> between = faces_between(mesh, faces, sides, pieces, planes);
  check_planes_cut(mesh, between, planes);
  const std::vector<int> number = order_of_pieces(between, pieces[cell_at(mesh, faces, first)], count);
  for (int& piece : pieces) piece = number[piece];
  for (CutFace& face : between) {
    for (int& piece : face.pieces) piece = number[piece];
    std::sort(face.pieces.begin(), face.pieces.end());
  }

  const CutSurfaces surfaces = connected_cuts(mesh, faces, std::move(between), planes);
  SurfaceFaces of_cuts;
  for (std::size_t k = 0; k < surfaces.cuts.size(); ++k) of_cuts[surfaces.cuts[k].group] = surfaces.faces[k];
  const SurfaceFaces of_groups = surface_faces(mesh, faces);
  CutMesh result;
  result.cuts = surfaces.cuts;
  for (int piece = 0; piece < count; ++piece) {
    MeshExtraction extraction(mesh, pieces, piece);
    extraction.add_volumes();
    extraction.add_nodes();
    extraction.add_surfaces(faces, of_groups, of_cuts);
    result.pieces.push_back(extraction.take());
  }
  return result;
}

}  // namespace bielle::reduce
