// Quadrature on the unit triangle and the unit tetrahedron.
//
// The 4-point rule of degree 2 for tetrahedra, and conical products of Gauss-Jacobi rules of any degree (all weights
// positive, all points inside). Reference: A. H. Stroud, Approximate Calculation of Multiple Integrals, 1971, ch. 2.4.
#pragma once

#include <Eigen/Core>

namespace bielle::reduce {

/// Points in local coordinates and weights that add up to the size of the unit simplex (1/2 or 1/6).
struct Quadrature {
  Eigen::MatrixXd points;  ///< (local dimension, points)
  Eigen::VectorXd weights;
};

/// A rule exact for polynomials up to `degree` >= 0. @param dimension  2 triangle, 3 tetrahedron
Quadrature simplex_quadrature(int dimension, int degree);

}  // namespace bielle::reduce
