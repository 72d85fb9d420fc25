// Start values of first-order unknowns that follow from the state: a filter begins with its input.
#pragma once

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Moves first-order unknowns to the start values of their components (Component::add_start_values), repeatedly until
/// none changes: one may depend on another. @returns whether any was changed
bool begin_first_order(const System& system, const Environment& environment, State& state);

/// Marks components as not yet begun: during an assembly the reactions, on which start values may depend, are not
/// known.
/// @param memory  memory of the state before it was accepted
void count_as_not_begun(const System& system, const VectorX& memory, State& state);

}  // namespace bielle::mechanism
