// What each piece of a cut body gets of the requests for the whole.
#pragma once

#include <vector>

#include "reduce/mesh/cut_mesh.hpp"
#include "reduce/reduction/options.hpp"
#include "reduce/superelement/cut_body.hpp"

namespace bielle::reduce {

/// How the body is to be cut, in addition to the planes.
struct PiecesRequest {
  Tie tie = Tie::rigid;  ///< of the surfaces where pieces meet
  bool compare = true;   ///< reduce the uncut body as well, to see what the cuts do to it
};

/// The cuts as the pieces' file describes them.
std::vector<CutSurface> cut_surfaces(const CutMesh& cut);

/// Requests for each piece: the interfaces, points, loads and materials that lie in it, and its sides of the cuts as
/// interfaces at one place. The total of a `force` is spread over all pieces that its surface reaches into. Damping by
/// ratios is left out: it is that of the whole body.
/// @throws InputError, with the place of the request, for an interface or point whose surface lies in several pieces,
/// and
///         for an interface that has the name of a cut
std::vector<ReductionOptions> piece_options(const Mesh& whole, const CutMesh& cut, const std::vector<CutPlane>& planes,
                                            const std::vector<CutSurface>& surfaces, const ReductionOptions& options,
                                            Tie tie);

}  // namespace bielle::reduce
