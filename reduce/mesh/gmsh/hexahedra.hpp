// Meshing of the geometry that gmsh has open into hexahedra.
#pragma once

#include <string>

#include "reduce/mesh/gmsh/meshing.hpp"
#include "reduce/mesh/gmsh/session.hpp"

namespace bielle::reduce {

/// The way in which hexahedra are made.
enum class HexahedralMesh {
  prescribed,  ///< the geometry itself prescribes them (transfinite or extruded volumes of a `.geo`)
  structured,  ///< every volume is a block of six faces with four edges each, in which the mesh is a grid
  subdivided   ///< a mesh of tetrahedra with twice the size, each divided into four hexahedra
};

/// Meshes the volumes into straight hexahedra: as the geometry prescribes, otherwise as grids, otherwise by
/// subdivision. The surfaces must be meshed with the same sizes; they are meshed anew unless the geometry prescribes
/// hexahedra.
/// @throws ComputationError when gmsh fails, or leaves a volume without cells
HexahedralMesh mesh_hexahedra(GmshSession& session, const std::string& name, const MeshSizes& sizes);

/// Tells the user about the origin of the hexahedra.
std::string describe(HexahedralMesh mesh);

}  // namespace bielle::reduce
