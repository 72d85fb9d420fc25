// Tiny edges and faces of a geometry are removed before it is meshed.
#pragma once

#include <vector>

#include "reduce/mesh/gmsh/solids.hpp"
#include "reduce/mesh/mesh_request.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle {
class Progress;
}

namespace bielle::reduce {

/// Replaces each solid by one without edges and faces that are smaller than a hundredth of `size`, with its faces sewn
/// together; a note gives the numbers of edges and faces before and after. Physical volumes are kept. Solids that
/// shared faces share none afterwards. gmsh's exceptions are not translated: the call belongs in session.read().
/// @param solids  all of the geometry; their volumes are replaced
/// @throws InputError for geometries of gmsh's own kernel, with physical surfaces or without `size`, and if a solid
/// does not remain one
void heal_solids(const MeshRequest& request, const SourceFile& source, std::vector<BodySolid>& solids,
                 Progress& progress);

}  // namespace bielle::reduce
