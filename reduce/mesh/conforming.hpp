// Checks that cells with common corners fit together: the displacements of both sides of a face must be the same.
#pragma once

#include "reduce/mesh/faces.hpp"
#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

/// Faces that two cells share must have the same nodes, not only the same corners; a quadrilateral must not lie on two
/// triangles, and no corner of a cell in the middle of an edge of another one (a hanging node).
/// @throws InputError with the kind, the number and the first place of what does not fit
void check_conforming(const Mesh& mesh, const FaceTable& faces);

}  // namespace bielle::reduce
