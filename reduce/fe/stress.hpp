// Stress at nodes.
//
// Stress is sampled at the four points of the degree 2 rule, where quadratic cells are most accurate, extrapolated
// linearly to the nodes of the cell and averaged over the cells around a node, weighted by their volume. At a node
// between two materials only the cells of one material count: the one with more volume around the node (stress jumps
// there).
#pragma once

#include <vector>

#include "reduce/fe/solid.hpp"
#include "reduce/sparse/symmetric_matrix.hpp"

namespace bielle::reduce {

/// @param fields  (3 points, k) displacements
/// @param nodes   nodes of the requested stresses, ascending, all of them in the solid
/// @returns (6 nodes, k): xx yy zz yz xz xy [Pa] of the first node, of the second, ...
RowMatrix nodal_stress(const Solid& solid, const RowMatrix& fields, const std::vector<int>& nodes, int threads = 1);

/// Numbers in `solid.materials` of the materials whose stress `nodal_stress` gives at these nodes.
std::vector<int> nodal_materials(const Solid& solid, const std::vector<int>& nodes);

/// Nodes on the faces of cells that belong to one cell only, ascending.
std::vector<int> surface_nodes(const Solid& solid);

}  // namespace bielle::reduce
