// Names of modes, derived from the entries of the model: "blade_*.blade along the axis, forwards".
#pragma once

#include <string>
#include <vector>

#include "mechanism/analyses/mode_arrays.hpp"

namespace bielle::mechanism {

/// Returns a name for each mode: the entry with the largest kinetic energy (entries whose names differ by numbers alone
/// count together, as `blade_*.blade`), the direction of most of its motion, and the sense of whirl of a turning part.
/// For entries behind a turning joint the direction is along or across its axis, otherwise an inertial one. A name is
/// empty if no entry of the mode has inertia.
std::vector<std::string> mode_names(const System& system, const ModesReport& report, const ModeParts& parts);

/// Adds "1st", "2nd", .. to names that occur more than once, ascending by rate. Empty names stay empty.
/// @param rates  |s| of each mode
std::vector<std::string> numbered_names(const std::vector<std::string>& names, const std::vector<double>& rates);

}  // namespace bielle::mechanism
