// Cuts in the geometry that gmsh has open, before it is meshed: both sides of a cut then share the mesh of its face.
#pragma once

#include <vector>

#include "reduce/mesh/gmsh/model.hpp"
#include "reduce/mesh/mesh_request.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// Divides the volumes at the planes `request.cuts`. Physical groups keep their names: a divided surface or volume is
/// replaced in the group by its parts. A geometry of gmsh's own kernel cannot be cut; it is not changed, and a note is
/// given.
/// @returns the physical groups of the divided geometry
/// @throws InputError when OpenCASCADE cannot cut it
std::vector<PhysicalGroup> cut_geometry(GmshSession& session, const MeshRequest& request, const SourceFile& source,
                                        Progress& progress);

}  // namespace bielle::reduce
