// The requests for each piece of a cut body, from those for the whole.
#pragma once

#include <vector>

#include "reduce/mesh/cut_mesh.hpp"
#include "reduce/reduction/options.hpp"
#include "reduce/superelement/cut_body.hpp"

namespace bielle::reduce {

/// The request for pieces, in addition to the planes.
struct PiecesRequest {
  Tie tie = Tie::rigid;  ///< tie of the surfaces between pieces
  bool compare = true;   ///< reduce the uncut body as well, to see what the cuts do to it
};

/// Returns the cuts for the pieces' file.
std::vector<CutSurface> cut_surfaces(const CutMesh& cut);

/// Requests for each piece: the interfaces, points, loads, masses and materials that lie in it, and its sides of the
/// cuts as interfaces at one place. The total of a `force` is distributed over all pieces that its surface touches.
/// Damping by ratios is left out, since the ratios are those of the whole body.
/// @throws InputError about an interface, point or mass whose surface lies in several pieces, or an interface with the
/// name of
///         a cut
std::vector<ReductionOptions> piece_options(const Mesh& whole, const CutMesh& cut, const std::vector<CutPlane>& planes,
                                            const std::vector<CutSurface>& surfaces, const ReductionOptions& options,
                                            Tie tie);

}  // namespace bielle::reduce
