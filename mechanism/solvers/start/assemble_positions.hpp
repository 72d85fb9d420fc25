// Positions that satisfy the holonomic constraints and the conditions of a start, near those that are drawn.
//
//   K dq + B^T mu = f_drawn - f(q),   B dq = -Phi      repeated: Newton's method (closing_equations.hpp)
//
// K and f are the elastic stiffness and forces, with a very little of unity added to K: bodies move rigidly rather than
// bend, and are as free of stress in the end as they were drawn. Among rigid motions the smallest is taken, so that of
// several ways to close a loop the one next to the drawing is found, or that which the start values choose.
//
// Parts may be drawn far from where they fit. A step turns no node by more than 0.3 rad; it is halved until the gaps
// shrink by a part of what the linear equations promise, and damped (Levenberg and Marquardt) where halving does not
// help: next to positions in which constraints repeat each other, or where they cannot all hold. Constraints that are
// set aside as redundant take part: parts drawn out of their plane come back to it.
//
// Where nothing closes, the gaps are brought together in the last joint or start value that disagrees, all others held
// (unclosed.hpp), and the message names it, the gap, and what it disagrees with. A joint whose axes come out opposite
// is turned as drawn, and all is tried once more.
#pragma once

#include "mechanism/solvers/start/start_conditions.hpp"
#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// Moves the state's positions until all holonomic constraints and the conditions hold. What moved is added to the
/// report.
/// @throws ComputationError naming what cannot be satisfied, with its gap; the state is then as it was
void assemble_positions(const System& system, const Environment& environment, State& state, StartReport& report,
                        const StartConditions& conditions = {});

}  // namespace bielle::mechanism
