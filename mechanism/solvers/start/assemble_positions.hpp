// Positions that satisfy the holonomic constraints and the conditions of a start, near the initial ones.
//
//   K dq + B^T mu = f_drawn - f(q),   B dq = -Phi      repeated: Newton's method (closing_equations.hpp)
//
// K and f are the elastic stiffness and forces, with a very small multiple of unity added to K: bodies move rigidly
// rather than deform, and their final stress is the initial one. The smallest rigid motion is used: if a loop can be
// closed in several ways, the one nearest to the initial positions is found, or the one selected by the start values.
//
// Parts may initially be far from positions that fit. A step rotates no node by more than 0.3 rad; it is halved until
// the gaps decrease by a fraction of the prediction of the linear equations, and damped (Levenberg and Marquardt) if
// halving does not help: near positions in which constraints are redundant, or in which they cannot all be satisfied.
// Constraints that are set aside as redundant are included: parts that are initially out of their plane move back to
// it.
//
// If the gaps cannot be closed, they are moved to the last contradictory joint or start value, with all others
// satisfied (unclosed.hpp), and the message names it, the gap, and the contradictory members. A joint whose axes become
// opposite is reversed in the initial positions, and everything is tried once more.
#pragma once

#include "mechanism/solvers/start/start_conditions.hpp"
#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// Moves the state's positions until all holonomic constraints and the conditions are satisfied. The movements are
/// added to the report.
/// @throws ComputationError naming the members that cannot be satisfied, with the gap; the state is then unchanged
void assemble_positions(const System& system, const Environment& environment, State& state, StartReport& report,
                        const StartConditions& conditions = {});

}  // namespace bielle::mechanism
