// The reduction of a body that is cut into pieces, for bodies that bend too much for one superelement.
#pragma once

#include <vector>

#include "reduce/reduction/piece_options.hpp"
#include "reduce/reduction/reduce_body.hpp"

namespace bielle::reduce {

/// Cuts a mesh at planes and reduces each piece with its own interfaces, its sides of the cuts, and its own modes.
///
/// A single `ratio` of damping applies to the first mode of all pieces together (damping_of_piece); modal damping of
/// each piece would damp the body's low modes by a fraction of it.
/// @param progress  shows pieces; gets warnings
/// @param checks  if given, receives the mass properties of the assembled pieces and those of the uncut mesh
/// @throws InputError for requests that do not fit the pieces, ComputationError as reduce_body, with the name of the
/// piece
CutBody reduce_pieces(const Mesh& mesh, const std::vector<CutPlane>& planes, const ReductionOptions& options,
                      const PiecesRequest& request, Progress& progress, int threads = 1,
                      std::vector<Check>* checks = nullptr, const MatrixMaker& make = assembled_matrices);

}  // namespace bielle::reduce
