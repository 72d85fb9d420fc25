// The reduction of foreign matrices to a superelement: method of Craig and Bampton, as for a mesh. Matrices that are
// reduced already take the same way: their scalars are the interior, all of whose modes are kept, so that the result
// has the interfaces' directions and fixed-boundary modes whatever the modes of the file were.
#pragma once

#include <string>
#include <vector>

#include "reduce/common/progress.hpp"
#include "reduce/matrices/body_inertia.hpp"
#include "reduce/matrices/matrix_options.hpp"
#include "reduce/matrices/matrix_set.hpp"
#include "reduce/reduction/reduce_body.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::reduce {

/// Without a request all modes of at most this many interior unknowns are kept.
inline constexpr Eigen::Index most_unasked_modes = 300;

/// Reduces the matrices of a body, or takes over those of a reduced one. The superelement has no stress, and no
/// geometric stiffness except that of the file, which belongs to the spin in the request.
/// @param set  as read; changed: empty unknowns are taken out, matrices made symmetric to rounding
/// @throws InputError about requests that do not fit, matrices that are not symmetric, that hold the body to the
/// ground,
///         or that do not fit the positions of the nodes; ComputationError if the interior is singular
Superelement reduce_matrices(MatrixSet& set, const MatrixOptions& options, Progress& progress, int threads = 1,
                             ReductionReport* report = nullptr);

}  // namespace bielle::reduce
