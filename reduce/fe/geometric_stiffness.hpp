// Geometric stiffness of a solid in a reduced basis, for the stresses of several displacement fields at once.
//
// g_ab = int dN_a/dx_i sigma_ij dN_b/dx_j dV [N/m], used as g (x) I3: u^T (g (x) I3) u / 2 is the work of the stress on
// the second-order strain (grad u)^T (grad u) / 2. In the basis T: T^T (g (x) I3) T.
// Quadrature is exact on straight cells (degree 3) and of degree 5 on curved ones.
#pragma once

#include <vector>

#include "reduce/fe/node_graph.hpp"
#include "reduce/fe/solid.hpp"

namespace bielle::reduce {

/// @param fields  (3 points, k) displacements u0, whose linear elastic stress is used
/// @param shapes  T (3 points, n)
/// @returns T^T (g (x) I3) T (n, n) for each field [N/m for shapes of displacements]
/// @note needs 8 k bytes for each pair of neighbouring nodes
std::vector<Eigen::MatrixXd> reduced_geometric_stiffness(const Solid& solid, const NodeGraph& graph,
                                                         const RowMatrix& fields, const RowMatrix& shapes,
                                                         int threads = 1);

}  // namespace bielle::reduce
