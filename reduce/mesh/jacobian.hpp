// The Jacobian of second-order tetrahedra, which tells whether a curved element is inverted anywhere.
#pragma once

#include <Eigen/Core>

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

/// Scaled Jacobian of a straight tetrahedron: the least over its corners of sqrt(2) det / (product of the three edges
/// that meet there); 1 for the regular one, 0 for a flat one.
double scaled_jacobian(const Eigen::Ref<const Eigen::Matrix3Xd>& nodes);

}  // namespace bielle::reduce
