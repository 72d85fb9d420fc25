// Meshes of triangles for drawings.
#pragma once

#include <memory>
#include <string>

#include "mechanism/drawing/drawn_item.hpp"

namespace bielle::mechanism {

/// Reads an STL file; equal corners become one point. @param scale  unit of its lengths [m] @throws InputError
std::shared_ptr<const DrawnMesh> mesh_of_stl(const std::string& path, double scale);

/// Returns the surface of a geometry (STEP, IGES, BREP) as triangles, made by bielle-reduce. A file that this program
/// has read before is not read again unless it has changed. @throws InputError if it cannot be read, or if
/// bielle-reduce is not installed
std::shared_ptr<const DrawnMesh> mesh_of_geometry(const std::string& path);

/// Returns a ring around z. @param radius  radius of the centre line [m] @param section  radius of the section [m]
std::shared_ptr<const DrawnMesh> mesh_of_ring(double radius, double section);

}  // namespace bielle::mechanism
