// Redundant constraints of a mechanism whose initial positions are inaccurate: they are determined at positions at
// which its parts fit.
#pragma once

#include "mechanism/solvers/start/start_conditions.hpp"

namespace bielle::mechanism {

/// Takes redundant constraints out of the equations at the start of a motion, as take_out_redundant() does, at
/// positions that satisfy the constraints. If no such positions are found, the initial ones are used; the assembly will
/// report the error.
/// @param state      state returned by System::start; its positions are not changed
/// @param assembled  receives those positions
/// @returns multipliers of the removed constraints, ascending
std::vector<int> take_out_redundant_at_start(System& system, const Environment& environment, State& state,
                                             State& assembled);

}  // namespace bielle::mechanism
