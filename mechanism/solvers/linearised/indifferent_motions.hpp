// Indifferent motions, which no force resists, of the linearised equations: u with D(0) u = 0 to the accuracy of D.
//
// In first-order form their eigenvalues are double zeros. Rounding splits them by its square root, so far that they may
// seem to be slow modes. They are therefore found as null vectors, as in statics. In the pencil
//     D(0) u = tau R u,      R = D(sigma) - D(0),
// which compares stiffness with the effect of inertia and damping at a rate sigma, they have tau = 0 as simple
// eigenvalues; D(sigma)^-1 R has the eigenvalues 1/(1 + tau), for any constraints. An eigenvalue counts as zero if |y^T
// D(0) u| does not exceed its rounding error (equation_rounding.hpp).
#pragma once

#include "mechanism/solvers/linearised/equation_rounding.hpp"

namespace bielle::mechanism {

struct IndifferentMotions {
  MatrixX shapes;         ///< (n, number) independent shapes
  double resolution = 0;  ///< smallest rate [1/s] that can be distinguished from them: slower motions may be included
  double slowest = 0;     ///< approximate rate of the slowest other motion [1/s]; 0: not known
};

/// @param rounding  receives the reactions due to errors of the equilibrium
/// @param dense     limit of unknowns for dense algebra
IndifferentMotions find_indifferent_motions(const LinearisedEquations& equations, EquationRounding& rounding,
                                            Eigen::Index dense);

}  // namespace bielle::mechanism
