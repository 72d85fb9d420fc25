// A consistent start of a motion: positions that satisfy the constraints, velocities and accelerations that satisfy
// their derivatives, and the multipliers that belong to the accelerations. Each has its own file in this folder.
#pragma once

#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// Computes positions, velocities and accelerations, in that order; directions without mass are balanced
/// (massless_balance.hpp).
/// @throws ComputationError as these functions do
StartReport make_consistent(const System& system, const Environment& environment, State& state);

}  // namespace bielle::mechanism
