// The Jacobian of cells, which tells whether an element is inverted, its volume and its quality.
#pragma once

#include <Eigen/Core>

#include "reduce/mesh/cell_type.hpp"

namespace bielle::reduce {

/// Local nodes at the two ends of the edge on which mid-side node 4 + k lies (gmsh's order).
inline constexpr int tet_edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}};

/// Six times the signed volume of the straight tetrahedron of the corners [m^3].
/// @param nodes  (3, 4 or more), corners first
double straight_determinant(const Eigen::Ref<const Eigen::Matrix3Xd>& nodes);

/// Bernstein coefficients of det(dx/dxi) of a tet10, a cubic polynomial [m^3].
///
/// The Bernstein polynomials are non-negative, add up to one and have equal integrals. The least coefficient is
/// therefore a lower bound of the determinant (the element is nowhere inverted if it is positive), and the mean one is
/// six times the volume of the curved element. All are equal when the element is straight. Reference: A. Johnen, J.-F.
/// Remacle, C. Geuzaine, Geometrical validity of curvilinear finite elements, J. Comput. Phys. 233 (2013) 359-372.
/// @param nodes  (3,10) in gmsh's order
Eigen::Matrix<double, 20, 1> determinant_coefficients(const Eigen::Ref<const Eigen::Matrix3Xd>& nodes);

/// Returns the type of the same shape with nodes at the vertices alone.
CellType straight_type(CellType type);

/// det(dx/dxi) [m^3] at the places at which a cell is checked: the constant value of tetrahedra of order 1, the
/// Bernstein coefficients of those of order 2. Other shapes are checked at the nodes of the type of order 2 that has
/// the most (of a pyramid except the apex, where the gradients do not exist) and the points of a rule of degree 4. The
/// straight cell and the curved one are checked at the same places: a straight cell that passes does so as a cell of
/// order 2, too.
/// @param nodes  (3, nodes of the type or more)
Eigen::VectorXd checked_determinants(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& nodes);

/// Volume of a cell, straight or curved; exact up to rounding [m^3].
double cell_volume(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& nodes);

/// Quality of a cell with straight edges: the least over its corners of c det / (product of the lengths), det and
/// product of three edges that meet there. The factor c makes it 1 for the regular cell: sqrt(2) for tetrahedra, 1 for
/// hexahedra (cube), 2/sqrt(3) for wedges (equilateral triangles and squares), sqrt(2) for pyramids (all edges equal;
/// at the apex, all four triples of its edges). It is 0 for a flat corner and negative for an inverted one.
double scaled_jacobian(CellType type, const Eigen::Ref<const Eigen::Matrix3Xd>& nodes);

}  // namespace bielle::reduce
