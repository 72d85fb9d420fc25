#include "mechanism/session/unique_reactions.hpp"

#include <algorithm>

#include "mechanism/solvers/constraints/reaction_norm.hpp"

namespace bielle::mechanism {

namespace {

/// Returns whether none of a member's multipliers is in the ascending list of those that are not unique.
bool all_unique(const Slots& slots, const std::vector<int>& free) {
  const auto first = std::lower_bound(free.begin(), free.end(), slots.multiplier_begin);
  return first == free.end() || *first >= slots.multiplier_begin + slots.multipliers;
}

}  // namespace

std::vector<std::pair<std::string, bool>> unique_reactions(const System& system, const Environment& environment,
                                                           const State& state) {
  std::vector<std::pair<std::string, bool>> joints;
  if (!ReactionNorm::needed(system, state)) return joints;
  const std::vector<int> free = ReactionNorm(system).not_unique(environment, state);
  const Model& model = system.model();
  for (const std::string& name : model.names_in(Section::joints)) {
    // The first member is the joint. A lock has its own multiplier, which is no part of the joint's reaction.
    const Slots& slots = system.slots()[model.members_of({Section::joints, name}).front()];
    if (slots.multipliers > 0) joints.emplace_back(name, all_unique(slots, free));
  }
  return joints;
}

NotUnique find_not_unique(const System& system, const Environment& environment, const State& state) {
  NotUnique found;
  if (!ReactionNorm::needed(system, state)) return found;
  const std::vector<int> free = ReactionNorm(system).not_unique(environment, state);
  const Model& model = system.model();
  for (std::size_t m = 0; m < model.members().size(); ++m) {
    const Slots& slots = system.slots()[m];
    if (slots.multipliers == 0 || all_unique(slots, free)) continue;
    const Entry& entry = model.members()[m].entry;
    if (entry.section == Section::drives)
      found.drives.push_back(entry.name);
    else if (entry.section == Section::joints && model.members_of(entry).front() == m)
      found.joints.push_back(entry.name);
    else if (entry.section == Section::joints && model.members()[m].component->type() == "lock" &&
             (found.locked.empty() || found.locked.back() != entry.name))
      found.locked.push_back(entry.name);
  }
  return found;
}

EntryNumbers unique_reaction_numbers(const System& system, const Environment& environment, const State& state) {
  EntryNumbers numbers{
      "reaction_unique",
      {},
      "-",
      "1 where the motion determines the reaction; 0 where redundant constraints leave it open, and the smallest is "
      "recorded"};
  for (const auto& [name, unique] : unique_reactions(system, environment, state))
    if (const Entry joint{Section::joints, name}; system.model().records(joint))
      numbers.values.emplace_back(joint, unique ? 1 : 0);
  return numbers;
}

}  // namespace bielle::mechanism
