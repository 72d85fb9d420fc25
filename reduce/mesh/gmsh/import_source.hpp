// Reads a mesh, or meshes a geometry, by gmsh.
#pragma once

#include "reduce/mesh/mesh.hpp"
#include "reduce/mesh/mesh_request.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// Does the work of `import_mesh` (import.hpp) in this process, which gmsh may end.
/// @throws InputError, ComputationError
Mesh import_source(const MeshRequest& request, const SourceFile& source, Progress& progress);

}  // namespace bielle::reduce
