#include "mechanism/session/unique_reactions.hpp"

#include <algorithm>

#include "mechanism/solvers/constraints/reaction_norm.hpp"

namespace bielle::mechanism {

std::vector<std::pair<std::string, bool>> unique_reactions(const System& system, const Environment& environment,
                                                           const State& state) {
  std::vector<std::pair<std::string, bool>> joints;
  if (!ReactionNorm::needed(system, state)) return joints;
  const std::vector<int> free = ReactionNorm(system).not_unique(environment, state);
  const Model& model = system.model();
  for (const std::string& name : model.names_in(Section::joints)) {
    // The joint comes first. What locks it has a multiplier of its own, which is no part of the joint's reaction.
    const Slots& slots = system.slots()[model.members_of({Section::joints, name}).front()];
    if (slots.multipliers == 0) continue;
    const auto first = std::lower_bound(free.begin(), free.end(), slots.multiplier_begin);
    joints.emplace_back(name, first == free.end() || *first >= slots.multiplier_begin + slots.multipliers);
  }
  return joints;
}

std::vector<std::string> joints_not_unique(const System& system, const Environment& environment, const State& state) {
  std::vector<std::string> names;
  for (const auto& [name, unique] : unique_reactions(system, environment, state))
    if (!unique) names.push_back(name);
  return names;
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
