// The surface of a geometry as triangles, by which it is drawn.
#pragma once

#include <optional>
#include <string>

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// Returns the surface of a geometry as the bytes of a binary STL file, in metres: triangles that are anticlockwise
/// seen from outside, finer where the surface is curved. The work runs in a child process.
/// @param length_unit   unit of a file that declares none; absent: m
/// @param system_calls  whether a script (.geo) may run shell commands
/// @throws InputError when the file cannot be read, is a mesh, or has no surface
/// @throws ComputationError when gmsh fails to mesh it
std::string surface_of_geometry(const std::string& path, const std::optional<std::string>& length_unit,
                                Progress& progress, bool system_calls = false);

}  // namespace bielle::reduce
