// The solids of a geometry that make the body: selected, healed, glued, and named for `regions`.
#pragma once

#include <vector>

#include "reduce/mesh/gmsh/model.hpp"
#include "reduce/mesh/mesh_request.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// Removes the solids that the request does not select, and heals and glues the others if it asks for that. If the
/// geometry has no physical volumes and the request names solids in `regions` or `mesh.sizes`, each name of a solid
/// becomes one.
/// @returns the physical groups of what is left
/// @throws InputError as `select_solids`, `heal_solids`, `glue_solids` and `check_one_piece`
std::vector<PhysicalGroup> assemble_solids(GmshSession& session, const MeshRequest& request, const SourceFile& source,
                                           Progress& progress);

}  // namespace bielle::reduce
