// Accelerations, multipliers, first-order rates and algebraic unknowns that belong to positions and velocities.
//
//   [M B^T; B 0][a; lambda] = [-g; -d2Phi/dt2 at a = 0],  first-order rates from their own equations
//
// Algebraic unknowns y, whose equations f(y, q, v, t) = 0 hold no rates, are found together with the accelerations,
// whose forces may depend on them: in [M B^T; B 0] there are then columns of y, with dg/dy, and rows of df/d(y, lambda,
// ...). Forces that depend on multipliers make the equations nonlinear: Newton's method then has
// [M B^T + df/dlambda; B 0], while velocities and everything else go by the constraints' own B^T.
//
// Where all of them enter linearly, one solution with [M B^T; B 0] finds them. Algebraic unknowns, and forces that
// depend on multipliers (friction on the reaction), take Newton's method. Where such forces are strong, there may be no
// solution, or two: P. Painleve, C. R. Acad. Sci. Paris 121 (1895) 112; F. Genot, B. Brogliato, Eur. J. Mech. A/Solids
// 18 (1999) 653. The matrix's determinant tells: continued from forces without that dependence, where the solution is
// unique, its sign stays the same as long as the solution is unique; and reactions of the opposite sign, from which the
// search begins once more, lead to the same solution.
#pragma once

#include "mechanism/solvers/constraints/mass_saddle.hpp"

namespace bielle::mechanism {

/// Sets accelerations, multipliers, first-order rates and algebraic unknowns in equilibrium with the state's positions
/// and velocities. What has neither mass nor constraint (a node between two springs) has no acceleration of its own: it
/// gets zero.
/// @param saddle  factors that serve are used, with refinement; otherwise they are made
/// @throws ComputationError naming an unknown without mass, an algebraic one that its equation does not determine, or
///         reactions for which there is no solution, or more than one (Painleve's paradox)
void make_accelerations_consistent(const System& system, const Environment& environment, State& state,
                                   MassSaddle& saddle);
void make_accelerations_consistent(const System& system, const Environment& environment, State& state);

/// The same from accelerations and multipliers of a state nearby, of which it is known that there is one solution: that
/// is not looked for again where forces depend on reactions.
void continue_accelerations(const System& system, const Environment& environment, State& state, MassSaddle& saddle);

}  // namespace bielle::mechanism
