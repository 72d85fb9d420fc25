// Whether numbers that come from outside (a checkpoint, a saved session, a user) are a state of this mechanism.
#pragma once

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// @throws InputError unless every list has the length that the mechanism asks for, every number is finite, the axes of
///         every node are a rotation, and each component knows its memory: names the node or component. An entry of a
///         memory that begins as no number may be none.
void check_state(const System& system, const State& state);

}  // namespace bielle::mechanism
