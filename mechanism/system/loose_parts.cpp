#include "mechanism/system/loose_parts.hpp"

#include <algorithm>
#include <numeric>

namespace bielle::mechanism {
namespace {

/// Disjoint sets of nodes, which are merged one by one; each is identified by its lowest node.
class Parts {
 public:
  explicit Parts(std::size_t nodes) : above_(nodes) { std::iota(above_.begin(), above_.end(), std::size_t{0}); }
  std::size_t of(std::size_t node) {
    while (above_[node] != node) node = above_[node] = above_[above_[node]];
    return node;
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t first = of(a), second = of(b);
    above_[std::max(first, second)] = std::min(first, second);
  }

 private:
  std::vector<std::size_t> above_;
};

}  // namespace

std::vector<int> loose_parts(const System& system) {
  const Model& model = system.model();
  const std::size_t count = model.nodes().size();
  Parts parts(count);
  std::vector<bool> attached(count, false), constrained(count, false);
  for (std::size_t m = 0; m < system.slots().size(); ++m) {
    const Section section = model.members()[m].entry.section;
    const std::vector<int>& nodes = system.slots()[m].nodes;
    if (section == Section::supports && system.slots()[m].multipliers > 0)
      for (const int node : nodes) constrained[static_cast<std::size_t>(node)] = true;
    if (section != Section::elements && section != Section::joints) continue;
    for (const int node : nodes) {
      attached[static_cast<std::size_t>(node)] = true;
      parts.join(static_cast<std::size_t>(nodes[0]), static_cast<std::size_t>(node));
    }
  }
  std::vector<bool> is_held(count, false);
  const auto held = [&](std::size_t node) {
    const auto& freedom = model.nodes()[node].freedom;
    return node == 0 || constrained[node] ||
           std::any_of(freedom.begin(), freedom.end(), [](Freedom f) { return f != Freedom::free; });
  };
  for (std::size_t k = 0; k < count; ++k)
    if (const auto carrier = model.nodes()[k].carrier) parts.join(static_cast<std::size_t>(*carrier), k);
  bool anything = false;
  for (std::size_t k = 0; k < count; ++k)
    if (attached[k] && held(k)) is_held[parts.of(k)] = anything = true;
  std::vector<int> result;
  if (!anything) return result;
  std::vector<bool> told(count, false);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t part = parts.of(k);
    if (!attached[k] || is_held[part] || told[part]) continue;
    told[part] = true;
    result.push_back(static_cast<int>(k));
  }
  return result;
}

}  // namespace bielle::mechanism
