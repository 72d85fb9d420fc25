// Import of a geometry or a mesh in any supported format as a mesh of solid cells in metres with named groups.
#pragma once

#include "reduce/mesh/mesh.hpp"
#include "reduce/mesh/mesh_request.hpp"

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// Reads the file, meshes it if it is a geometry, checks the mesh and names its groups.
///
/// Geometries (.geo, .step/.stp, .brep, .iges/.igs) are meshed by gmsh; meshes are read by gmsh (.msh, .unv) or
/// converted by tools/convert_mesh.py (.inp, .bdf, .nas, .vtu, .vtk, .med and all other formats of meshio). The result
/// has solid cells of any types of cell_type.hpp, of positive Jacobian, that fit together; its surface cells are those
/// of its surface groups, all points are used, and lengths are in metres. Without physical volumes the whole body
/// becomes the group `all`.
///
/// The import runs in a child process: this program survives if gmsh crashes on a damaged file.
///
/// Second-order elements that a curved boundary inverts are repaired by moving mid-side nodes to the middle of their
/// edges; a note gives their number.
///
/// @param progress  shows the phases, gets warnings and notes
/// @throws InputError about the key of the request, with the fault and the remedy
/// @throws ComputationError when gmsh fails to mesh a sound geometry
Mesh import_mesh(const MeshRequest& request, Progress& progress);

}  // namespace bielle::reduce
