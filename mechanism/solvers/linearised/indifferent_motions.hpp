// Motions that no force resists, of the linearised equations: u with D(0) u = 0 to what D is known to.
//
// In first-order form their eigenvalues are double zeros, which rounding splits by its square root, far enough to pass
// for slow modes. They are therefore found as what they are in statics, null vectors. In the pencil
//     D(0) u = tau R u,      R = D(sigma) - D(0),
// which weighs stiffness against what inertia and damping make of a rate sigma, they have tau = 0 and are no more than
// single; D(sigma)^-1 R has the eigenvalues 1/(1 + tau), whatever the constraints. An eigenvalue counts as zero where
// |y^T D(0) u| is not more than rounding makes of it (equation_rounding.hpp).
#pragma once

#include "mechanism/solvers/linearised/equation_rounding.hpp"

namespace bielle::mechanism {

struct IndifferentMotions {
  MatrixX shapes;         ///< (n, number) independent ones
  double resolution = 0;  ///< a rate [1/s] that none of them can be told from: what is slower may count among them
  double slowest = 0;     ///< about that of the slowest other motion [1/s]; 0: not known
};

/// @param rounding  receives the reactions that errors of the equilibrium stand for
/// @param dense     up to so many unknowns by dense algebra
IndifferentMotions find_indifferent_motions(const LinearisedEquations& equations, EquationRounding& rounding,
                                            Eigen::Index dense);

}  // namespace bielle::mechanism
