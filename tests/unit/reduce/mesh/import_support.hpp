// Geometries and meshes as text, and their import, for tests.
#pragma once

#include <string>
#include <vector>

#include "reduce/mesh/mesh.hpp"
#include "reduce/mesh/mesh_request.hpp"

namespace bielle::test {

/// Returns a request without a body file.
reduce::MeshRequest request(const std::string& path);

/// import_mesh without output.
reduce::Mesh import(const reduce::MeshRequest& request);

/// Returns the InputError of import_mesh.
std::string import_message(const reduce::MeshRequest& request);

/// Returns a selection by one selector.
reduce::SurfaceSelection selection(const std::string& group, const reduce::SurfaceSelector& selector);

/// gmsh's format 2.2 of points (rows "x y z") and elements (rows "type number-of-tags tags.. nodes.."), numbered
/// from 1.
/// @param names  rows `dimension number "name"`
std::string msh(const std::vector<std::string>& points, const std::vector<std::string>& elements,
                const std::vector<std::string>& names = {});

/// Returns the same text of a mesh, each of its groups a physical one.
std::string as_msh(const reduce::Mesh& mesh);

/// Lets gmsh mesh a geometry and write it in the format of `target`'s ending (a geometry's ending: unmeshed).
void gmsh_convert(const std::string& source, const std::string& target, double size, int order);

/// Returns the area vector of a surface group of triangles with straight edges: outward normals weighted by area [m^2].
Eigen::Vector3d area_vector(const reduce::Mesh& mesh, const std::string& group);

/// Returns the area of a surface group by its triangles' corners [m^2].
double corner_area(const reduce::Mesh& mesh, const std::string& group);

}  // namespace bielle::test
