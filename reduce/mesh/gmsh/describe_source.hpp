// The description of a geometry or mesh that `bielle-reduce --list` prints.
#pragma once

#include <map>
#include <string>

#include "reduce/mesh/source_file.hpp"

namespace bielle::reduce {

/// Does the work of `describe_geometry` (describe.hpp) in this process, which gmsh may end.
/// @param path       the user's name of the file
/// @param densities  densities of regions [kg/m^3]
/// @throws InputError when the file cannot be read
std::string describe_source(const std::string& path, const SourceFile& source,
                            const std::map<std::string, double>& densities);

}  // namespace bielle::reduce
