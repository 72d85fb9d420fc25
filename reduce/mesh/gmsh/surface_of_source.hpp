// The surface of a geometry as triangles, by which it is drawn.
#pragma once

#include <string>

#include "reduce/mesh/source_file.hpp"

namespace bielle::reduce {

/// Does the work of `surface_of_geometry` (geometry_surface.hpp) in this process, which gmsh may end.
/// @throws InputError when the file cannot be read or has no surface
/// @throws ComputationError when gmsh fails to mesh it
std::string surface_of_source(const SourceFile& source);

}  // namespace bielle::reduce
