// Reactions of joints, drives and locks that redundant constraints leave undetermined.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mechanism/results/result_sink.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Returns the joints with constraints, in the model's order, and whether all multipliers of each are unique at a
/// state. The list is empty if no constraint is redundant: all are then unique.
std::vector<std::pair<std::string, bool>> unique_reactions(const System& system, const Environment& environment,
                                                           const State& state);
/// Names of components with reactions or forces that are not unique, in the model's order.
struct NotUnique {
  std::vector<std::string> joints, drives;
  std::vector<std::string> locked;  ///< joints whose lock forces are not unique
  bool none() const { return joints.empty() && drives.empty() && locked.empty(); }
};
NotUnique find_not_unique(const System& system, const Environment& environment, const State& state);
/// Returns `reaction_unique`, 1 or 0, of each joint that records its results.
EntryNumbers unique_reaction_numbers(const System& system, const Environment& environment, const State& state);

}  // namespace bielle::mechanism
