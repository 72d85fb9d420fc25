// A start from which a motion can begin: positions that satisfy the constraints, velocities and accelerations that keep
// them satisfied, and the multipliers that go with the accelerations. Each has its own file in this folder.
#pragma once

#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// Positions, velocities and accelerations, in that order; directions without mass are balanced (massless_balance.hpp).
/// @throws ComputationError as each of them does
StartReport make_consistent(const System& system, const Environment& environment, State& state);

}  // namespace bielle::mechanism
