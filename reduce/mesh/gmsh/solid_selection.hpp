// The solids of an assembly that the body file selects by `volume` or `volumes`.
#pragma once

#include <vector>

#include "reduce/mesh/gmsh/solids.hpp"
#include "reduce/mesh/mesh_request.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle::reduce {

/// Removes the solids that the request does not select from the geometry that gmsh has open; physical groups keep what
/// is left of them. A selection is the number of a solid, a physical volume, or a name of solids, in this order. gmsh's
/// exceptions are not translated: the call belongs in session.read().
/// @returns the solids that are left; all if the request selects none
/// @throws InputError for numbers and names of no solid, for solids that are selected twice, and if the request names a
/// group that the removed solids alone have
std::vector<BodySolid> select_solids(const MeshRequest& request, const SourceFile& source);

}  // namespace bielle::reduce
