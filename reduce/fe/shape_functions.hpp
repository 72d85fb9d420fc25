// Shape functions of tetrahedra and triangles of order 1 and 2, in gmsh's node order.
//
// On the unit simplex with barycentric coordinates l_0 = 1 - sum xi, l_k = xi_k: vertices N_k = l_k (order 1) or
// l_k (2 l_k - 1) (order 2), mid-side node of edge (a,b) N = 4 l_a l_b. Edges of tet10: 01 12 02 03 23 13, of tri6:
// 01 12 02.
#pragma once

#include <Eigen/Core>

#include "reduce/mesh/mesh.hpp"

namespace bielle::reduce {

/// N_a at a point. @param xi  local coordinates, 3 for tetrahedra, 2 for triangles
Eigen::VectorXd shape_values(CellType type, const Eigen::VectorXd& xi);

/// dN_a/dxi_k at a point: (nodes, local dimension)
Eigen::MatrixXd shape_gradients(CellType type, const Eigen::VectorXd& xi);

/// Vertices of the type: 4 or 3, its first nodes.
int vertex_count(CellType type);

/// The two vertices of each mid-side node, in the order of the nodes: (2, mid-side nodes).
Eigen::Matrix2Xi edges_of(CellType type);

}  // namespace bielle::reduce
