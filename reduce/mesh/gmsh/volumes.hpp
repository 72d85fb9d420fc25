// Volumes of the geometries from which meshes are made.
#pragma once

#include <optional>
#include <string>

namespace bielle::reduce {

/// Volume of all solids of the geometry that gmsh has open, in its own unit; they must be of the OpenCASCADE kernel.
/// gmsh's exceptions are not translated.
double volume_of_solids();

/// Volume of a geometry of the OpenCASCADE kernel, without meshing it [m^3].
/// @throws InputError when the file cannot be read or its volumes are not OpenCASCADE's
double geometry_volume(const std::string& path, const std::optional<std::string>& length_unit = {});

}  // namespace bielle::reduce
