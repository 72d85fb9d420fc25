// Solids that touch each other become one body.
#pragma once

#include <vector>

#include "reduce/mesh/gmsh/solids.hpp"
#include "reduce/mesh/mesh_request.hpp"
#include "reduce/mesh/source_file.hpp"

namespace bielle {
class Progress;
}

namespace bielle::reduce {

// Both functions call gmsh without translating its exceptions: they belong in session.read().

/// Gives solids of the geometry that gmsh has open common faces where they touch, and replaces the physical groups
/// accordingly.
/// @param solids  all of the geometry; their volumes are replaced
/// @throws InputError for solids that overlap, and for geometries of gmsh's own kernel
void glue_solids(const MeshRequest& request, const SourceFile& source, std::vector<BodySolid>& solids,
                 Progress& progress);

/// @throws InputError if the solids do not hang together by common faces, edges or points
void check_one_piece(const MeshRequest& request, const SourceFile& source, const std::vector<BodySolid>& solids);

}  // namespace bielle::reduce
