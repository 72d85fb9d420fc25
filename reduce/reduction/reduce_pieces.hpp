// The reduction of a body that is cut into pieces, for bodies that bend too much for one superelement.
#pragma once

#include <vector>

#include "reduce/reduction/piece_options.hpp"
#include "reduce/reduction/reduce_body.hpp"

namespace bielle::reduce {

/// Cuts a mesh at planes and reduces each piece: its own interfaces and its sides of the cuts, and its own modes.
///
/// One `ratio` of damping is that of the first mode of all pieces together (damping_of_piece); modal damping of each
/// piece would damp the body's low modes by a fraction of it.
/// @param progress  shows pieces; gets warnings
/// @param checks  filled when given: mass properties of the assembled pieces against those of the uncut mesh
/// @throws InputError for requests that do not fit the pieces, ComputationError as reduce_body, naming the piece
CutBody reduce_pieces(const Mesh& mesh, const std::vector<CutPlane>& planes, const ReductionOptions& options,
                      const PiecesRequest& request, Progress& progress, int threads = 1,
                      std::vector<Check>* checks = nullptr, const MatrixMaker& make = assembled_matrices);

}  // namespace bielle::reduce
