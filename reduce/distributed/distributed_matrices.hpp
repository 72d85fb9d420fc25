// The mesh's matrices in parts, one on each rank: each rank assembles those of its cells, and the factor of the whole
// interior is MUMPS's, distributed. Fields on the mesh are kept in this process; rows of a part's points are sent to
// its rank and back.
#pragma once

#include <memory>

#include "reduce/distributed/channel.hpp"
#include "reduce/reduction/body_matrices.hpp"

namespace bielle::reduce {

/// @param channel  to the ranks, which serve one body at a time; has to live longer than the matrices
/// @param ranks    >= 1
/// @param threads  number of threads of each rank
/// @throws ComputationError as assembled_matrices, and if a rank fails
std::unique_ptr<BodyMatrices> distributed_matrices(Channel& channel, int ranks, const Solid& solid, int threads);

}  // namespace bielle::reduce
