// From the geometry that gmsh has open to its mesh, as the body file asks for it.
#pragma once

#include <vector>

#include "reduce/mesh/gmsh_model.hpp"
#include "reduce/mesh/mesh_request.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// Meshes surfaces, then volumes. Mistakes that would show only after a long time are found early: that the mesh
/// would be too large (a forgotten unit of length, a size in the wrong unit) before anything is meshed, that
/// a shape selects no surface when the surfaces are.
/// @param groups  physical groups of the geometry
/// @throws InputError naming the place in the input file; ComputationError when gmsh fails
void mesh_geometry(GmshSession& session, const MeshRequest& request, const SourceFile& source,
                   const std::vector<PhysicalGroup>& groups, Progress& progress);

}  // namespace bielle::reduce
