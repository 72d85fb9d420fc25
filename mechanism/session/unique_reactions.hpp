// Reactions that redundant constraints leave undetermined: of joints, drives and locks.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mechanism/results/result_sink.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Joints that hold constraints, in the model's order, and whether all of each one's multipliers are unique at a state.
/// Empty where nothing is redundant: all are.
std::vector<std::pair<std::string, bool>> unique_reactions(const System& system, const Environment& environment,
                                                           const State& state);
/// Names of what has reactions or forces that are not unique, in the model's order.
struct NotUnique {
  std::vector<std::string> joints, drives;
  std::vector<std::string> locked;  ///< joints, by the forces of their locks
  bool none() const { return joints.empty() && drives.empty() && locked.empty(); }
};
NotUnique find_not_unique(const System& system, const Environment& environment, const State& state);
/// `reaction_unique`, 1 or 0, of each joint that records its results.
EntryNumbers unique_reaction_numbers(const System& system, const Environment& environment, const State& state);

}  // namespace bielle::mechanism
