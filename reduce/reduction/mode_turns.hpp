// Rotations and strains of the body in its coordinates at places spread over it. A mechanism judges by them the error
// of a linear body that bends in its modes while its interfaces stand still, or that is strained too far.
#pragma once

#include <string>

#include "reduce/fe/solid.hpp"
#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle::reduce {

/// Rotations (half the curl, reduce/superelement/point_weights.hpp) at nodes that are spread over the body, each as far
/// as possible from those before it.
/// @param shapes  (3 points, n), of which the last m, from `first` on, are the modes @param body  its name, for
/// messages
/// @returns (3 q, m), body axes; q at most 24
Eigen::MatrixXd mode_turns(const Solid& solid, const RowMatrix& shapes, Eigen::Index first, const std::string& body);

/// Strains xx yy zz yz xz xy (engineering shears) at the same places, of the displacement field that is linear in space
/// and nearest to the displacements of the surrounding nodes: it averages over about one element and contains no peaks
/// at notches. The mean over the body follows.
/// @returns (6 (q + 1), n), body axes
Eigen::MatrixXd place_strains(const Solid& solid, const RowMatrix& shapes, const std::string& body);

}  // namespace bielle::reduce
