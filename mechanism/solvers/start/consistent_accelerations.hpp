// Accelerations, multipliers, first-order rates and algebraic unknowns that are consistent with positions and
// velocities.
//
//   [M B^T; B 0][a; lambda] = [-g; -d2Phi/dt2 at a = 0],  first-order rates from their own equations
//
// Algebraic unknowns y, whose equations f(y, q, v, t) = 0 contain no rates, are computed together with the
// accelerations, whose forces may depend on them: in [M B^T; B 0] there are then columns of y, with dg/dy, and rows of
// df/d(y, lambda, ...). Forces that depend on multipliers make the equations nonlinear: Newton's method then has the
// matrix [M B^T + df/dlambda; B 0], while velocities and everything else use the constraints' own B^T.
//
// If all unknowns enter linearly, one solution with [M B^T; B 0] is sufficient. Algebraic unknowns, and forces that
// depend on multipliers (friction on the reaction), require Newton's method. If such forces are strong, there may be no
// solution, or two: P. Painleve, C. R. Acad. Sci. Paris 121 (1895) 112; F. Genot, B. Brogliato, Eur. J. Mech. A/Solids
// 18 (1999) 653. The matrix's determinant shows this: starting from forces without that dependence, for which the
// solution is unique, its sign does not change as long as the solution is unique; and reactions of the opposite sign,
// from which a second search starts, lead to the same solution.
#pragma once

#include "mechanism/solvers/constraints/kkt_matrix.hpp"

namespace bielle::mechanism {

/// Sets accelerations, multipliers, first-order rates and algebraic unknowns in equilibrium with the state's positions
/// and velocities. Nodes with neither mass nor constraint (a node between two springs) have no acceleration of their
/// own: it is set to zero.
/// @param saddle  valid factors are used, with refinement; otherwise they are computed
/// @throws ComputationError naming an unknown without mass, an algebraic one that its equation does not determine, or
///         reactions for which there is no solution, or more than one (Painleve's paradox)
void make_accelerations_consistent(const System& system, const Environment& environment, State& state,
                                   KktMatrix& saddle);
void make_accelerations_consistent(const System& system, const Environment& environment, State& state);

/// Does the same from accelerations and multipliers of a state nearby, for which the solution is known to be unique:
/// uniqueness is not checked again if forces depend on reactions.
void continue_accelerations(const System& system, const Environment& environment, State& state, KktMatrix& saddle);

}  // namespace bielle::mechanism
