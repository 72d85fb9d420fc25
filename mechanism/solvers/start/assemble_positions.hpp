// Positions that satisfy the holonomic constraints, near those that are drawn.
//
//   K dq + B^T mu = f_drawn - f(q),   B dq = -Phi      repeated: Newton's method
//
// K and f are the elastic stiffness and forces, with a very little of unity added to K: bodies move rigidly rather than
// bend, and are as free of stress in the end as they were drawn.
#pragma once

#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// Moves the state's positions until all holonomic constraints hold.
/// @throws ComputationError naming the constraint that cannot be satisfied
void assemble_positions(const System& system, const Environment& environment, State& state, StartReport& report);

}  // namespace bielle::mechanism
