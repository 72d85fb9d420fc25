// How far the modes turn the body from place to place: by this a mechanism judges how wrong a linear body is that bends
// in its modes, its interfaces standing still.
#pragma once

#include <string>

#include "reduce/fe/solid.hpp"
#include "reduce/spectral/symmetric_matrix.hpp"

namespace bielle::reduce {

/// Rotations (half the curl, reduce/superelement/point_weights.hpp) at nodes that are spread over the body, each as far
/// as possible from those before it.
/// @param shapes  (3 points, n), of which the modes are those from `first` on, m @param body  its name, for messages
/// @returns (3 q, m), body axes; q at most 24
Eigen::MatrixXd mode_turns(const Solid& solid, const RowMatrix& shapes, Eigen::Index first, const std::string& body);

}  // namespace bielle::reduce
