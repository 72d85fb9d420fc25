#include "mechanism/system/echoes.hpp"

#include <algorithm>
#include <limits>

namespace bielle::mechanism {

Echoes::Echoes(const System& system) : system_(system) {
  const std::vector<Member>& members = system.model().members();
  for (std::size_t m = 0; m < members.size(); ++m)
    if (const auto* echo = dynamic_cast<const Echo*>(members[m].component.get())) echoes_.push_back({echo, m});
}

/// Changes the memory of all echoes; each echo uses the unchanged memory of the others.
template <class Change>
void Echoes::change_memory(State& state, const Change& change) const {
  if (none()) return;
  VectorX memory = state.memory;
  for (const Placed& each : echoes_) {
    const Slots& slots = system_.slots()[each.member];
    change(*each.echo, slots, memory.segment(slots.memory_begin, slots.memories));
  }
  state.memory.swap(memory);
}

void Echoes::note_jump(State& state, const Environment& environment, double time) const {
  change_memory(state, [&](const Echo& echo, const Slots& slots, Eigen::Ref<VectorX> memory) {
    echo.note_jump({state, slots, environment}, time, memory);
  });
}

double Echoes::next(const State& state, const Environment& environment, double after) const {
  double first = std::numeric_limits<double>::infinity();
  for (const Placed& each : echoes_)
    first = std::min(first, each.echo->next_echo({state, system_.slots()[each.member], environment}, after));
  return first;
}

void Echoes::forget(State& state) const {
  change_memory(state, [](const Echo& echo, const Slots&, Eigen::Ref<VectorX> memory) { echo.forget(memory); });
}

}  // namespace bielle::mechanism
