// Meshing of the geometry that gmsh has open, as the body file requests it.
#pragma once

#include <vector>

#include "reduce/mesh/gmsh/model.hpp"
#include "reduce/mesh/mesh_request.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// Meshes surfaces, then volumes. Mistakes are found early: a mesh that would be too large (a forgotten unit of length,
/// a size in the wrong unit) before anything is meshed, a shape that selects no surface after the surfaces are meshed.
/// @param groups  physical groups of the geometry
/// @throws InputError about the key of the request; ComputationError when gmsh fails
void mesh_geometry(GmshSession& session, const MeshRequest& request, const SourceFile& source,
                   const std::vector<PhysicalGroup>& groups, Progress& progress);

}  // namespace bielle::reduce
