// The constraints of activated entries fit: parts are joined where they are, at velocities that may jump.
#pragma once

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Checks the constraints of members that are active at a state and were not with an earlier memory.
/// @param memory  memory of the components just before
/// @throws ComputationError naming the constraint that is open, with its gap
void check_activated_fit(const System& system, const Environment& environment, const State& state,
                         const VectorX& memory);

}  // namespace bielle::mechanism
