// Redundant constraints of a mechanism that is drawn roughly: they are found where its parts fit.
#pragma once

#include "mechanism/solvers/start/start_conditions.hpp"

namespace bielle::mechanism {

/// Takes what is redundant where a motion is to begin out of the equations, as take_out_redundant() does, at the
/// positions in which the constraints hold. Where none are found, it goes by the drawing; assembly will tell.
/// @param state      as System::start gives it; its positions stay as they are
/// @param assembled  receives those positions
/// @returns multipliers, ascending
std::vector<int> take_out_redundant_at_start(System& system, const Environment& environment, State& state,
                                             State& assembled);

}  // namespace bielle::mechanism
