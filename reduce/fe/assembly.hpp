// Stiffness and mass of a solid.
//
// Stiffness K_ab,ik = sum_jl C_ijkl int dN_a/dx_j dN_b/dx_l dV, quadrature exact for straight cells (4 points for
// tet10) and of degree 5 for curved tetrahedra, which keeps the patch test exact there too (int dN/dx dV is of degree
// 3); 2 or 3 points in each direction of other cells, by their order. hex8 and wedge6 have internal modes
// (internal_modes.hpp). Consistent mass m_ab = int rho N_a N_b dV, integrated exactly on straight cells and on
// curved tetrahedra, with 4 points in each direction of other curved cells: the common 4-point rule of tet10 would cost
// 5e-4 in frequencies. Coatings add int m'' N_a N_b dA of their faces, whose nodes share a cell. A lumped solid has a
// diagonal in place of the mass of each cell and face, of the same sum (cell_mass.hpp).
#pragma once

#include "reduce/fe/node_graph.hpp"
#include "reduce/fe/solid.hpp"

namespace bielle::reduce {

/// K (3 points, 3 points) [N/m], unknowns x y z of node 0, of node 1, ...; rows of points outside the solid are zero
/// except for a zero on the diagonal.
/// @throws ComputationError if a cell is inverted: its number and its place
SymmetricMatrix assemble_stiffness(const Solid& solid, const NodeGraph& graph, int threads = 1);

/// Scalar mass matrix m [kg]: the mass matrix of the solid is m (x) I3.
/// @throws ComputationError as assemble_stiffness
NodeMatrix assemble_mass(const Solid& solid, const NodeGraph& graph, int threads = 1);
NodeMatrix assemble_mass(const Solid& solid, NodeGraph&& graph, int threads = 1) = delete;  // the matrix refers to it

}  // namespace bielle::reduce
