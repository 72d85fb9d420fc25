// Start values of first-order unknowns that follow from the state: a filter begins at its input.
#pragma once

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Moves first-order unknowns to where their components say that they begin (Component::add_start_values), again and
/// again until all stay: one may follow from another. @returns whether any was moved
bool begin_first_order(const System& system, const Environment& environment, State& state);

/// Undoes that components count as begun: an assembly knows no reactions, from which start values may follow.
/// @param memory  of the state before it was accepted
void count_as_not_begun(const System& system, const VectorX& memory, State& state);

}  // namespace bielle::mechanism
