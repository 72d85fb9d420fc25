// Shape functions of all types of cells, in gmsh's node order and reference cells: simplices with corners 0, e1, e2,
// e3; quadrilaterals and hexahedra [-1, 1]^d; wedges, a triangle times [-1, 1]; pyramids over the base [-1, 1]^2 with
// the apex (0, 0, 1).
//
// Order 2 has a node in the middle of each edge (serendipity), quad9 and hex27 also of each face and of the cell. Those
// of pyramids are rational: G. Bedrosian, Shape functions and integration formulas for three-dimensional finite element
// analysis, Int. J. Numer. Meth. Engng 35 (1992) 95-108.
#pragma once

#include <Eigen/Core>

#include "reduce/mesh/cell_type.hpp"

namespace bielle::reduce {

/// N_a at a point. @param xi  local coordinates, as many as the dimension of the type
Eigen::VectorXd shape_values(CellType type, const Eigen::VectorXd& xi);

/// dN_a/dxi_k at a point: (nodes, local dimension). Those of a pyramid do not exist at its apex.
Eigen::MatrixXd shape_gradients(CellType type, const Eigen::VectorXd& xi);

/// Places of the nodes in the reference cell: (local dimension, nodes).
Eigen::MatrixXd local_nodes(CellType type);

}  // namespace bielle::reduce
