// Start values of first-order unknowns that follow from the state: a filter begins at its input.
#pragma once

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Moves first-order unknowns to where their components say that they begin (Component::add_start_values), again and
/// again until all stay: one may follow from another. @returns whether any was moved
bool begin_first_order(const System& system, const Environment& environment, State& state);

}  // namespace bielle::mechanism
