// Determines the times at which steps of a motion must end.
#pragma once

#include "mechanism/session/motion.hpp"
#include "mechanism/session/notes.hpp"

namespace bielle::mechanism {

/// Returns the requested step options with the break points of the model; fixed steps are adjusted to a whole number.
/// @param begin  start of the motion [s] @param notes  receives a note if the step size is changed; may be nullptr
StepOptions stepping_of(const DynamicsOptions& options, const System& system, double begin, Notes* notes);

}  // namespace bielle::mechanism
