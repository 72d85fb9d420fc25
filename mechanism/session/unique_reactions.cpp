#include "mechanism/session/unique_reactions.hpp"

#include <algorithm>

#include "mechanism/solvers/reaction_norm.hpp"

namespace bielle::mechanism {
namespace {

const std::string section = "joints/";

}  // namespace

std::vector<std::pair<std::string, bool>> unique_reactions(const System& system, const Environment& environment,
                                                           const State& state) {
  std::vector<std::pair<std::string, bool>> joints;
  if (!ReactionNorm::needed(system, state)) return joints;
  const std::vector<int> free = ReactionNorm(system).not_unique(environment, state);
  const std::vector<Member>& members = system.model().members();
  for (std::size_t m = 0; m < members.size(); ++m) {
    // What drives and locks a joint is recorded in its group.
    if (members[m].group != section + members[m].component->name() || system.slots()[m].multipliers == 0) continue;
    const int begin = system.slots()[m].multiplier_begin, end = begin + system.slots()[m].multipliers;
    const auto first = std::lower_bound(free.begin(), free.end(), begin);
    joints.emplace_back(members[m].component->name(), first == free.end() || *first >= end);
  }
  return joints;
}

std::vector<std::string> joints_not_unique(const System& system, const Environment& environment, const State& state) {
  std::vector<std::string> names;
  for (const auto& [name, unique] : unique_reactions(system, environment, state))
    if (!unique) names.push_back(name);
  return names;
}

std::vector<ResultArray> unique_reaction_arrays(const System& system, const Environment& environment,
                                                const State& state) {
  std::vector<ResultArray> arrays;
  for (const auto& [name, unique] : unique_reactions(system, environment, state))
    if (system.model().records(section + name))
      arrays.push_back({section + name + "/reaction_unique",
                        {},
                        {unique ? 1.0 : 0.0},
                        "-",
                        "1 where the motion determines the reaction; 0 where redundant constraints leave it open, and the "
                        "smallest is recorded"});
  return arrays;
}

}  // namespace bielle::mechanism
