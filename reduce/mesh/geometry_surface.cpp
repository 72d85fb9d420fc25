#include "reduce/mesh/geometry_surface.hpp"

#include <bit>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>
#include <gmsh.h>

#include "reduce/common/error.hpp"
#include "reduce/common/process/child_process.hpp"
#include "reduce/mesh/gmsh_model.hpp"

namespace bielle::reduce {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

/// Fineness of what is drawn: triangles per turn of a curved surface, and their largest and smallest size relative to
/// the largest side of the whole.
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
    std::vector<std::pair<int, int>> volumes;
    gmsh::model::getEntities(volumes, 3);
    for (const auto& [dimension, tag] : volumes) gmsh::model::mesh::setOutwardOrientation(tag);
  });
}

void append_bytes(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

/// The bytes of a binary STL file: 80 of a header, the number of triangles, 50 for each.
std::string stl_of_surfaces(const std::map<int, std::vector<Corners>>& surfaces, const Eigen::Matrix3Xd& points) {
  std::string triangles;
  std::uint32_t count = 0;
  for (const auto& [entity, faces] : surfaces)
    for (const Corners& face : faces)
      for (const auto& triangle : triangles_of(face)) {
        const Eigen::Vector3f normal = area_vector(points, triangle).normalized().cast<float>();
        append_bytes(triangles, normal.data(), 12);
        for (const int node : triangle) {
          const Eigen::Vector3f corner = points.col(node).cast<float>();
          append_bytes(triangles, corner.data(), 12);
        }
        triangles.append(2, '\0');
        ++count;
      }
  std::string bytes(80, '\0');
  append_bytes(bytes, &count, sizeof count);
  return bytes + triangles;
}

std::string surface_of_source(const SourceFile& source) {
  GmshSession session;
  open_model(session, source);
  mesh_drawn_surface(session, source, model_extent(session));
  Eigen::Matrix3Xd points;
  const auto surfaces = extract_surfaces(session, source.name, source.metres, points);
  if (surfaces.empty()) throw InputError(fmt::format("'{}' has no surface", source.name));
  return stl_of_surfaces(surfaces, points);
}

}  // namespace

std::string surface_of_geometry(const std::string& path, const std::optional<std::string>& length_unit,
                                Progress& progress, bool system_calls) {
  MeshRequest request;
  request.path = path;
  request.length_unit = length_unit;
  const SourceFile source = prepare_source(request, progress);
  if (!source.geometry)
    throw InputError(fmt::format("'{}' is a mesh, not a geometry (.step, .brep, .iges, .geo)", path));
  return in_child_process(loss_of(source), {}, [&] {
    if (!system_calls) forbid_system_calls(source);
    return surface_of_source(source);
  });
}

}  // namespace bielle::reduce
