// How far the modes turn the body from place to place, and how far all coordinates strain it there: by this a mechanism
// judges how wrong a linear body is that bends in its modes, its interfaces standing still, or is strained too far.
#pragma once

#include <string>

#include "reduce/fe/solid.hpp"
#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle::reduce {

/// Rotations (half the curl, reduce/superelement/point_weights.hpp) at nodes that are spread over the body, each as far
/// as possible from those before it.
/// @param shapes  (3 points, n), of which the modes are those from `first` on, m @param body  its name, for messages
/// @returns (3 q, m), body axes; q at most 24
Eigen::MatrixXd mode_turns(const Solid& solid, const RowMatrix& shapes, Eigen::Index first, const std::string& body);

/// Strains xx yy zz yz xz xy (engineering shears) at the same places, of the displacements that are linear in space and
/// nearest to those of the nodes around: what an element across has, no peak of a notch. Then the mean over the body.
/// @returns (6 (q + 1), n), body axes
Eigen::MatrixXd place_strains(const Solid& solid, const RowMatrix& shapes, const std::string& body);

}  // namespace bielle::reduce
