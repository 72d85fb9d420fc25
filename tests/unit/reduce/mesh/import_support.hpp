// Functions of tests that write geometries and meshes as text, and import them.
#pragma once

#include <string>
#include <vector>

#include "reduce/mesh/mesh.hpp"
#include "reduce/mesh/mesh_request.hpp"

namespace bielle::test {

/// Returns a request without a body file.
reduce::MeshRequest request(const std::string& path);

/// Imports a mesh without printing progress.
reduce::Mesh import(const reduce::MeshRequest& request);

/// Returns the message of the InputError that the import throws.
std::string import_message(const reduce::MeshRequest& request);

/// Returns a selection by one selector.
reduce::SurfaceSelection selection(const std::string& group, const reduce::SurfaceSelector& selector);

/// Returns a mesh in gmsh's format 2.2 from points (rows "x y z") and elements (rows "type number-of-tags tags..
/// nodes.."), which are numbered from 1.
/// @param names  rows `dimension number "name"`
std::string msh(const std::vector<std::string>& points, const std::vector<std::string>& elements,
                const std::vector<std::string>& names = {});

/// Returns the text of a mesh in this format; each group becomes a physical one.
std::string as_msh(const reduce::Mesh& mesh);

/// Calls gmsh to mesh a geometry and to write it in the format given by the extension of `target`. A geometry's
/// extension writes the geometry without a mesh.
void gmsh_convert(const std::string& source, const std::string& target, double size, int order);

/// Returns the area vector of a surface group of triangles with straight edges: outward normals weighted by area [m^2].
Eigen::Vector3d area_vector(const reduce::Mesh& mesh, const std::string& group);

/// Returns the area of a surface group, from the corners of its triangles [m^2].
double corner_area(const reduce::Mesh& mesh, const std::string& group);

}  // namespace bielle::test
