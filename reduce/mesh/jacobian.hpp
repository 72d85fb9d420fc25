// The Jacobian of second-order tetrahedra: is a curved element the right way round everywhere?
#pragma once

#include <Eigen/Core>

namespace bielle::reduce {

/// Local nodes at the two ends of the edge on which mid-side node 4 + k lies (gmsh's order).
inline constexpr int tet_edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}};

/// Six times the signed volume of the straight tetrahedron of the corners [m^3].
/// @param nodes  (3, 4 or more), corners first
double straight_determinant(const Eigen::Ref<const Eigen::Matrix3Xd>& nodes);

/// A lower bound of det(dx/dxi) over a tet10 [m^3], exact when the element is straight: the least coefficient of the
/// determinant, a cubic polynomial, in the Bernstein basis, whose functions are non-negative and add up to one. The
/// element is the right way round everywhere when it is positive. It takes the four corner values for what they are, so
/// that it is also no more than the least value at a corner.
/// Reference: A. Johnen, J.-F. Remacle, C. Geuzaine, Geometrical validity of curvilinear finite elements, J. Comput.
/// Phys. 233 (2013) 359-372.
/// @param nodes  (3,10) in gmsh's order
double least_determinant(const Eigen::Ref<const Eigen::Matrix3Xd>& nodes);

/// Scaled Jacobian of a straight tetrahedron: the least over its corners of sqrt(2) det / (product of the three edges
/// that meet there); 1 for the regular one, 0 for a flat one.
double scaled_jacobian(const Eigen::Ref<const Eigen::Matrix3Xd>& nodes);

}  // namespace bielle::reduce
