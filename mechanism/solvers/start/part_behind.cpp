#include "mechanism/solvers/start/part_behind.hpp"

#include <algorithm>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bielle::mechanism {
namespace {

/// A member that connects nodes. Rigid carriers are edges as well, without a member.
struct Tie {
  std::vector<int> nodes;
  std::size_t member = none;
  bool gives = false;  ///< it does not prevent the motion of the moving side
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
};

std::vector<Tie> ties_of(const System& system, std::size_t joint, const std::function<bool(std::size_t)>& allows) {
  const Model& model = system.model();
  std::vector<Tie> ties;
  for (std::size_t m = 0; m < system.slots().size(); ++m) {
    const Section section = model.members()[m].entry.section;
    const Slots& slots = system.slots()[m];
    if (m == joint || slots.nodes.size() < 2 || (section != Section::elements && section != Section::joints)) continue;
    Declaration declaration;
    model.members()[m].component->declare(declaration);
    const bool gives = !declaration.mass && (slots.multipliers == 0 || allows(m));
    ties.push_back({slots.nodes, m, gives});
  }
  for (std::size_t k = 0; k < model.nodes().size(); ++k)
    if (const auto carrier = model.nodes()[k].carrier)
      ties.push_back({{static_cast<int>(k), *carrier}, Tie::none, false});
  return ties;
}

/// Nodes that are reachable from others, and the tie by which each was reached.
class Reach {
 public:
  Reach(const std::vector<Tie>& ties, std::size_t nodes)
      : ties_(ties), at_(nodes), by_(nodes, -1), from_(nodes, -1), reached_(nodes, false) {
    for (std::size_t t = 0; t < ties.size(); ++t)
      for (const int node : ties[t].nodes) at_[static_cast<std::size_t>(node)].push_back(static_cast<int>(t));
  }
  /// @param through  whether a tie may be crossed @param enters  whether a node may be entered
  template <class Through, class Enters>
  void from(const std::vector<int>& begin, const Through& through, const Enters& enters) {
    std::deque<int> waiting(begin.begin(), begin.end());
    for (const int node : begin) reached_[static_cast<std::size_t>(node)] = true;
    while (!waiting.empty()) {
      const int node = waiting.front();
      waiting.pop_front();
      for (const int t : at_[static_cast<std::size_t>(node)]) {
        if (!through(ties_[static_cast<std::size_t>(t)])) continue;
        for (const int other : ties_[static_cast<std::size_t>(t)].nodes) {
          const auto k = static_cast<std::size_t>(other);
          if (reached_[k] || !enters(other)) continue;
          reached_[k] = true;
          by_[k] = t;
          from_[k] = node;
          waiting.push_back(other);
        }
      }
    }
  }
  bool reached(int node) const { return reached_[static_cast<std::size_t>(node)]; }
  /// Returns the members on the path to a node, from its beginning.
  std::vector<std::size_t> way_to(int node) const {
    std::vector<std::size_t> members;
    for (; by_[static_cast<std::size_t>(node)] >= 0; node = from_[static_cast<std::size_t>(node)]) {
      const std::size_t member = ties_[static_cast<std::size_t>(by_[static_cast<std::size_t>(node)])].member;
      if (member != Tie::none) members.insert(members.begin(), member);
    }
    return members;
  }

 private:
  const std::vector<Tie>& ties_;
  std::vector<std::vector<int>> at_;  ///< ties of each node
  std::vector<int> by_, from_;
  std::vector<bool> reached_;
};

/// Returns names of members, each once (a beam has many members).
std::string names_of(const System& system, const std::vector<std::size_t>& members) {
  std::vector<std::string> names;
  for (const std::size_t m : members) {
    std::string name = describe(system.model().members()[m]);
    if (names.empty() || names.back() != name) names.push_back(std::move(name));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

bool all_held(const Node& node) {
  return std::none_of(node.freedom.begin(), node.freedom.end(), [](Freedom f) { return f == Freedom::free; });
}

PartBehind part_behind(const System& system, std::size_t joint, int moving, int base,
                       const std::function<bool(std::size_t)>& allows) {
  const Model& model = system.model();
  const std::vector<Tie> ties = ties_of(system, joint, allows);
  const std::size_t count = model.nodes().size();
  const auto anywhere = [](int) { return true; };
  const auto firm = [](const Tie& tie) { return !tie.gives; };
  const auto any = [](const Tie&) { return true; };
  std::vector<int> held{base};
  for (int k = 0; k < static_cast<int>(count); ++k)
    if (k != base && all_held(model.node(k))) held.push_back(k);

  PartBehind part;
  Reach firmly(ties, count);
  firmly.from({moving}, firm, anywhere);
  for (const int node : held)
    if (firmly.reached(node)) {
      part.way_back = names_of(system, firmly.way_to(node));
      return part;
    }
  // The rest of the mechanism: held nodes, and nodes that lead to them without the part.
  Reach rest(ties, count);
  rest.from(held, any, [&](int node) { return !firmly.reached(node); });
  Reach behind(ties, count);
  behind.from({moving}, any, [&](int node) { return !rest.reached(node); });
  for (int k = 0; k < static_cast<int>(count); ++k)
    if (behind.reached(k)) part.nodes.push_back(k);
  return part;
}

}  // namespace bielle::mechanism
