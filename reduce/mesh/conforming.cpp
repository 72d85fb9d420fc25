#include "reduce/mesh/conforming.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reduce/common/counted.hpp"
#include "reduce/common/error.hpp"
#include "reduce/common/sort_unique.hpp"
#include "reduce/mesh/place.hpp"
#include "reduce/mesh/sorted_points.hpp"

namespace bielle::reduce {

namespace {

// Places of one kind of fault: their number and the first of them.
struct Faults {
  int count = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  void add(const Eigen::Vector3d& place) {
    if (count++ == 0) first = place;
  }
};

Eigen::Vector3d middle(const Mesh& mesh, const Corners& corners) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int node : corners) sum += mesh.points.col(node);
  return sum / corners.size();
}

void check_common_faces(const Mesh& mesh, const FaceTable& faces) {
  const SolidCells cells(mesh);
  Faults faults;
  std::set<std::string> kinds;
  for (int face = 0; face < faces.size(); ++face) {
    if (faces.on_boundary(face) || faces.same_on_both_sides(face)) continue;
    faults.add(middle(mesh, faces.corners(face)));
    for (const int cell : {faces.cell(face), faces.other_cell(face)}) kinds.insert(cell_name(cells.type(cell)));
  }
  if (faults.count == 0) return;
  throw InputError(fmt::format(
      "{} between cells {} not have the same nodes on both sides ({}), the first at {}: the body would be torn open "
      "between the corners; {}",
      counted(faults.count, "face"), faults.count == 1 ? "does" : "do", fmt::join(kinds, ", "),
      place_name(faults.first),
      kinds.size() > 1 ? "use cells with the same number of nodes on an edge and on a face" : "merge the nodes"));
}

// A quadrilateral on the boundary that two triangles on the boundary cover.
void check_divided_faces(const Mesh& mesh, const FaceTable& faces) {
  Faults faults;
  const auto open = [&](const Corners& triangle) {
    const auto face = faces.find(triangle);
    return face && faces.on_boundary(*face);
  };
  for (int face = 0; face < faces.size(); ++face) {
    if (!faces.on_boundary(face)) continue;
    const Corners c = faces.corners(face);
    if (c.size() == 4 && ((open({c[0], c[1], c[2]}) && open({c[0], c[2], c[3]})) ||
                          (open({c[0], c[1], c[3]}) && open({c[1], c[2], c[3]}))))
      faults.add(middle(mesh, c));
  }
  if (faults.count == 0) return;
  throw InputError(fmt::format(
      "{} of solid cells {} against two triangles, the first at {}: the displacements of both sides would part there; "
      "pyramids join hexahedra and tetrahedra",
      counted(faults.count, "quadrilateral face"), faults.count == 1 ? "stands" : "stand", place_name(faults.first)));
}

// Pairs of corners of the faces on the boundary, each once.
std::vector<std::array<int, 2>> boundary_edges(const FaceTable& faces) {
  std::vector<std::array<int, 2>> edges;
  for (const int face : faces.boundary()) {
    const Corners c = faces.corners(face);
    for (int k = 0; k < c.size(); ++k) {
      const int a = c[k], b = c[(k + 1) % c.size()];
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  sort_unique(edges);
  return edges;
}

// Corners of cells on the boundary that lie in the middle of an edge of another cell there and divide it in two.
// (Both sides of a slit have nodes of their own.)
void check_hanging_nodes(const Mesh& mesh, const FaceTable& faces) {
  const std::vector<std::array<int, 2>> edges = boundary_edges(faces);
  std::vector<int> corners;
  for (const auto& edge : edges) corners.insert(corners.end(), edge.begin(), edge.end());
  const SortedPoints sorted(mesh.points, corners);
  const auto is_edge = [&](int a, int b) {
    return std::binary_search(edges.begin(), edges.end(), std::array<int, 2>{std::min(a, b), std::max(a, b)});
  };
  Faults faults;
  for (const auto& [a, b] : edges) {
    const Eigen::Vector3d half = (mesh.points.col(a) + mesh.points.col(b)) / 2;
    const double near = 1e-6 * (mesh.points.col(a) - mesh.points.col(b)).norm();
    if (sorted.has_near(half, near, [&, a = a, b = b](int node) { return is_edge(a, node) && is_edge(node, b); }))
      faults.add(half);
  }
  if (faults.count == 0) return;
  throw InputError(fmt::format(
      "{} of solid cells {} a corner of another cell in {} middle, the first at {}: hanging nodes join nothing; divide "
      "the larger cells there too",
      counted(faults.count, "edge"), faults.count == 1 ? "has" : "have", faults.count == 1 ? "its" : "their",
      place_name(faults.first)));
}

}  // namespace

void check_conforming(const Mesh& mesh, const FaceTable& faces) {
  check_common_faces(mesh, faces);
  check_divided_faces(mesh, faces);
  check_hanging_nodes(mesh, faces);
}

}  // namespace bielle::reduce
