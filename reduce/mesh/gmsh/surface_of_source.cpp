#include "reduce/mesh/gmsh/surface_of_source.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include <fmt/format.h>
#include <gmsh.h>

#include "reduce/common/error.hpp"
#include "reduce/mesh/gmsh/model.hpp"

namespace bielle::reduce {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

/// Fineness of the drawing: triangles per turn of a curved surface, and their largest and smallest size relative to the
/// largest side of the whole.
constexpr double drawn_per_turn = 24, drawn_coarsest = 0.1, drawn_finest = 0.002;

void mesh_drawn_surface(GmshSession& session, const SourceFile& source, double extent) {
  session.compute(fmt::format("the surface of '{}' cannot be meshed", source.name), [&] {
    gmsh::option::setNumber("Mesh.ElementOrder", 1);
    gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
    gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", drawn_per_turn);
    gmsh::option::setNumber("Mesh.MeshSizeMax", drawn_coarsest * extent);
    gmsh::option::setNumber("Mesh.MeshSizeMin", drawn_finest * extent);
    gmsh::model::mesh::generate(2);
  });
}

void append_bytes(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

using SurfaceTriangle = std::array<int, 3>;

double volume_below(const Eigen::Matrix3Xd& points, const SurfaceTriangle& t) {
  return points.col(t[0]).dot(points.col(t[1]).cross(points.col(t[2]))) / 6;
}

/// Triangles at each edge, whose ends are in ascending order.
std::map<std::pair<int, int>, std::vector<std::size_t>> triangles_at_edges(const std::vector<SurfaceTriangle>& all) {
  std::map<std::pair<int, int>, std::vector<std::size_t>> edges;
  for (std::size_t k = 0; k < all.size(); ++k)
    for (std::size_t corner = 0; corner < 3; ++corner)
      edges[std::minmax(all[k][corner], all[k][(corner + 1) % 3])].push_back(k);
  return edges;
}

bool runs_along(const SurfaceTriangle& t, int from, int to) {
  return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) || (t[2] == from && t[0] == to);
}

/// Orients triangles: neighbours alike, and each connected surface so that the volume inside of it is positive. gmsh's
/// own function does not end for some geometries.
void orient_outwards(const Eigen::Matrix3Xd& points, std::vector<SurfaceTriangle>& all) {
  const auto edges = triangles_at_edges(all);
  std::vector<bool> known(all.size(), false);
  for (std::size_t first = 0; first < all.size(); ++first) {
    if (known[first]) continue;
    std::vector<std::size_t> surface = {first};
    known[first] = true;
    double volume = 0;
    for (std::size_t next = 0; next < surface.size(); ++next) {
      const SurfaceTriangle t = all[surface[next]];
      volume += volume_below(points, t);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const int from = t[corner], to = t[(corner + 1) % 3];
        const std::vector<std::size_t>& at = edges.at(std::minmax(from, to));
        if (at.size() != 2) continue;  // an open edge, or solids that touch
        const std::size_t other = at[0] == surface[next] ? at[1] : at[0];
        if (known[other]) continue;
        known[other] = true;
        if (runs_along(all[other], from, to)) std::swap(all[other][1], all[other][2]);
        surface.push_back(other);
      }
    }
    if (volume < 0)
      for (const std::size_t k : surface) std::swap(all[k][1], all[k][2]);
  }
}

/// Returns the bytes of a binary STL file: 80 of a header, the number of triangles, 50 for each.
std::string stl_of_triangles(const Eigen::Matrix3Xd& points, const std::vector<SurfaceTriangle>& triangles) {
  const auto count = static_cast<std::uint32_t>(triangles.size());
  std::string bytes(80, '\0');
  append_bytes(bytes, &count, sizeof count);
  for (const SurfaceTriangle& triangle : triangles) {
    const Eigen::Vector3f normal = area_vector(points, triangle).normalized().cast<float>();
    append_bytes(bytes, normal.data(), 12);
    for (const int node : triangle) {
      const Eigen::Vector3f corner = points.col(node).cast<float>();
      append_bytes(bytes, corner.data(), 12);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace

std::string surface_of_source(const SourceFile& source) {
  GmshSession session;
  open_model(session, source);
  mesh_drawn_surface(session, source, model_extent(session));
  Eigen::Matrix3Xd points;
  const auto surfaces = extract_surfaces(session, source.name, source.metres, points);
  std::vector<SurfaceTriangle> triangles;
  for (const auto& [entity, faces] : surfaces)
    for (const Corners& face : faces)
      for (const SurfaceTriangle& triangle : triangles_of(face)) triangles.push_back(triangle);
  if (triangles.empty()) throw InputError(fmt::format("'{}' has no surface", source.name));
  orient_outwards(points, triangles);
  return stl_of_triangles(points, triangles);
}

}  // namespace bielle::reduce
