// Which joints' reactions redundant constraints leave undetermined.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mechanism/session/result_sink.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Joints that hold constraints, in the model's order, and whether all of each one's multipliers are unique at a state.
/// Empty where nothing is redundant: all are.
std::vector<std::pair<std::string, bool>> unique_reactions(const System& system, const Environment& environment,
                                                           const State& state);
/// Names of those whose reactions are not unique.
std::vector<std::string> joints_not_unique(const System& system, const Environment& environment, const State& state);
/// `reaction_unique`, 1 or 0, of each joint that records its results.
EntryNumbers unique_reaction_numbers(const System& system, const Environment& environment, const State& state);

}  // namespace bielle::mechanism
