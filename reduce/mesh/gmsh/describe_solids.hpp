// The solids of a geometry as text for `--list`.
#pragma once

#include <map>
#include <string>

#include <Eigen/Geometry>

namespace bielle::reduce {

/// Lines with the assembly as a tree: names of assemblies and parts, and below them the number, name, volume, mass and
/// box of each solid. The geometry that gmsh has open is described; gmsh's exceptions are not translated.
/// @param boxes      boxes of the surfaces, by their numbers in gmsh [m]
/// @param metres     metres per unit of the model
/// @param densities  densities of regions, which are physical volumes, names of solids or "all" [kg/m^3]; masses of
/// other solids are left out
std::string solids_text(const std::map<int, Eigen::AlignedBox3d>& boxes, double metres,
                        const std::map<std::string, double>& densities);

}  // namespace bielle::reduce
