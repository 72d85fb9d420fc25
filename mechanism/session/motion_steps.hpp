// These functions tell where the steps of a motion have to end.
#pragma once

#include "mechanism/session/motion.hpp"
#include "mechanism/session/notes.hpp"

namespace bielle::mechanism {

/// The asked steps with the kinks of the model; fixed ones a whole number of them.
/// @param begin  of the motion [s] @param notes  are told of steps of another size; nullptr: nobody is
StepOptions stepping_of(const DynamicsOptions& options, const System& system, double begin, Notes* notes);

}  // namespace bielle::mechanism
