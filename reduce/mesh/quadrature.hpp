// Quadrature on the reference cells of all types.
//
// The 4-point rule of degree 2 for tetrahedra, conical products of Gauss-Jacobi rules of any degree on simplices and
// pyramids, and products of Gauss rules (all weights positive, all points inside). Reference: A. H. Stroud, Approximate
// Calculation of Multiple Integrals, 1971, ch. 2.4.
#pragma once

#include <Eigen/Core>

#include "reduce/mesh/cell_type.hpp"

namespace bielle::reduce {

/// Points in local coordinates and weights that add up to the size of the reference cell.
struct Quadrature {
  Eigen::MatrixXd points;  ///< (local dimension, points)
  Eigen::VectorXd weights;
};

/// Returns a rule exact for polynomials up to `degree` >= 0. @param dimension  2 triangle, 3 tetrahedron
Quadrature simplex_quadrature(int dimension, int degree);

/// Returns a rule for a type of cell, exact for polynomials up to `degree`: of degree as a whole on simplices, along
/// each coordinate on quadrilaterals and hexahedra, in the triangle and along the height on wedges; on pyramids of
/// functions that are polynomials of x/(1 - z), y/(1 - z) and z.
Quadrature cell_quadrature(CellType type, int degree);

}  // namespace bielle::reduce
