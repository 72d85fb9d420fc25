// The description of a geometry or mesh that `bielle-reduce --list` prints.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// Volumes, surfaces with their shapes, physical groups and units of a file, as text for the terminal, with lines for a
/// body file that select each surface.
///
/// A geometry is not meshed: its shapes are recognised from points on its surfaces, areas and volumes come from
/// OpenCASCADE (geometries of gmsh's own kernel have none). The boundary of a mesh is divided at edges at which its
/// normal turns by more than 40 degrees.
/// @param length_unit   unit of a file that declares none; absent: m
/// @param system_calls  whether a script (.geo) may run shell commands
/// @param densities     densities of regions [kg/m^3], from which the masses of solids follow; see `solids_text`
/// @throws InputError when the file cannot be read
std::string describe_geometry(const std::string& path, const std::optional<std::string>& length_unit,
                              Progress& progress, bool system_calls = false,
                              const std::map<std::string, double>& densities = {});

}  // namespace bielle::reduce
