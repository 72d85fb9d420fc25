// Checks that numbers from outside (a checkpoint, a saved session, a user) are a valid state of this mechanism.
#pragma once

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// @throws InputError unless every list has the required length, every number is finite, the axes of every node are a
///         rotation, and each component accepts its memory. The message names the node or component. An
///         entry of a memory whose initial value is not a number may also be not a number.
void check_state(const System& system, const State& state);

}  // namespace bielle::mechanism
