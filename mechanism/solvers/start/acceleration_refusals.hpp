// Errors about accelerations that do not exist, or are not unique, because forces depend on reactions.
#pragma once

#include <string>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Returns the name of a multiplier with the entry it belongs to.
std::string multiplier_name(const System& system, int multiplier);

/// @param time  [s]
/// @param how  how the solutions differ
/// @param multiplier  multiplier that is not unique; -1: not known
/// @throws ComputationError always
[[noreturn]] void throw_ambiguous_accelerations(const System& system, double time, const std::string& how,
                                                int multiplier);

/// @param time  [s]
/// @param worst  multiplier for which the search did not converge; -1: the equations could not be evaluated
/// @param paradox  the equations have become singular between forces that do not depend on reactions and these
/// @throws ComputationError always
[[noreturn]] void throw_no_accelerations(const System& system, double time, int worst, bool paradox);

}  // namespace bielle::mechanism
