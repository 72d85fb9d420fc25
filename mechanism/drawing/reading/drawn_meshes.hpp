// Meshes of triangles for drawings.
#pragma once

#include <memory>
#include <string>

#include "mechanism/drawing/drawn_item.hpp"

namespace bielle::mechanism {

/// Reads an STL file; equal corners become one point. @param scale  unit of its lengths [m] @throws InputError
std::shared_ptr<const DrawnMesh> mesh_of_stl(const std::string& path, double scale);

/// Returns a ring around z. @param radius  radius of the centre line [m] @param section  radius of the section [m]
std::shared_ptr<const DrawnMesh> mesh_of_ring(double radius, double section);

}  // namespace bielle::mechanism
