// From a geometry or a mesh in any supported format to a mesh of tetrahedra in metres with named groups.
#pragma once

#include "reduce/mesh/mesh.hpp"
#include "reduce/mesh/mesh_request.hpp"

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// Reads, meshes where needed, checks and names.
///
/// Geometries (.geo, .step/.stp, .brep, .iges/.igs) are meshed by gmsh; meshes are read by gmsh (.msh, .unv) or
/// converted by tools/convert_mesh.py (.inp, .bdf, .nas, .vtu, .vtk, .med and what else meshio reads). The result has
/// one type of solid cells (tet4 or tet10, all of positive Jacobian), its surface cells are those of its surface
/// groups, all points are used, lengths are metres. Without physical volumes the whole body becomes the group `all`.
///
/// All of it happens in a process of its own: where gmsh crashes on a damaged file, this program does not.
///
/// Second-order elements that a curved boundary turns inside out are repaired by moving mid-side nodes to the middle of
/// their edges; how many is noted.
///
/// @param progress  shows the phases, gets warnings and notes
/// @throws InputError naming the place in the input file, what is wrong and what would be right
/// @throws ComputationError when gmsh fails to mesh a sound geometry
Mesh import_mesh(const MeshRequest& request, Progress& progress);

}  // namespace bielle::reduce
