// The Jacobian of solid cells, which tells whether one is inverted, flat or badly shaped.
#pragma once

#include <Eigen/Core>

#include "reduce/mesh/cell_type.hpp"

namespace bielle::reduce {

/// Local nodes at the two ends of the edge on which mid-side node 4 + k lies (gmsh's order).
inline constexpr int tet_edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}};

/// Six times the signed volume of the straight tetrahedron of the corners [m^3].
/// @param nodes  (3, 4 or more), corners first
double straight_determinant(const Eigen::Ref<const Eigen::Matrix3Xd>& nodes);

/// The least triple product of the three edges that meet at a vertex of a cell with straight edges, which is negative
/// if the cell is inverted there [m^3]; the apex of a pyramid, where four edges meet, is left out.
/// @param nodes  (3, vertices or more), vertices first
double least_triple_product(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& nodes);

/// Volume of a cell, which may be curved [m^3]. @param nodes  (3, nodes)
double cell_volume(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& nodes);

/// Whether the determinant of a curved cell may fall below a share of that of the straight cell: a lower bound says so
/// for tetrahedra, the values at nodes and quadrature points for others. @param nodes  (3, nodes) of a cell of order 2
bool may_be_inverted(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& nodes, double share);

/// The places of all nodes of a cell with straight edges and nodes in their middle. @param nodes  vertices first
Eigen::Matrix3Xd straight_nodes(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& nodes);

/// Bernstein coefficients of det(dx/dxi) of a tet10, a cubic polynomial [m^3].
///
/// The Bernstein polynomials are non-negative, add up to one and have equal integrals. The least coefficient is
/// therefore a lower bound of the determinant (the element is nowhere inverted if it is positive), and the mean one is
/// six times the volume of the curved element. All are equal when the element is straight. Reference: A. Johnen, J.-F.
/// Remacle, C. Geuzaine, Geometrical validity of curvilinear finite elements, J. Comput. Phys. 233 (2013) 359-372.
/// @param nodes  (3,10) in gmsh's order
Eigen::Matrix<double, 20, 1> determinant_coefficients(const Eigen::Ref<const Eigen::Matrix3Xd>& nodes);

/// Scaled Jacobian of a cell with straight edges: the least over its vertices of the triple product of the three edges
/// that meet there over the product of their lengths, in units of that of the regular cell: 1 for a cube or a regular
/// tetrahedron, 0 for a flat cell. @param nodes  vertices first
double scaled_jacobian(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& nodes);

}  // namespace bielle::reduce
