#include "mechanism/system/branches.hpp"

#include <algorithm>
#include <atomic>

#include "mechanism/model/event_actions.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

void Branches::add(const Declaration& declaration) {
  const std::size_t index = members_++;
  if (!declaration.memory.empty()) remembering_.push_back(index);
  for (int k = 0; k < static_cast<int>(declaration.event_functions.size()); ++k) {
    const EventFunction& function = declaration.event_functions[static_cast<std::size_t>(k)];
    const std::string owner = describe(model_.members()[index]);
    event_functions_.push_back({index, k, function, function.name.empty() ? owner : owner + ": " + function.name});
    event_functions_read_reactions_ = event_functions_read_reactions_ || function.reads_reaction;
  }
  if (declaration.passive) return;  // measures are evaluated by the components that use them
  reads_reactions_ = reads_reactions_ || declaration.reads_reactions;
  kinks_ = kinks_ || declaration.kinks || declaration.reads_reactions;
}

void Branches::calc_event_functions(const State& state, const Environment& environment,
                                    Eigen::Ref<VectorX> values) const {
  for (std::size_t k = 0; k < event_functions_.size();) {
    const std::size_t member = event_functions_[k].member;
    std::size_t end = k;
    while (end < event_functions_.size() && event_functions_[end].member == member) ++end;
    const auto count = static_cast<Eigen::Index>(end - k);
    if (unknowns_.is_active(state, member))
      model_.members()[member].component->calc_event_functions(local(state, member, environment),
                                                               values.segment(static_cast<Eigen::Index>(k), count));
    else
      values.segment(static_cast<Eigen::Index>(k), count).setZero();  // no event occurs in a released part
    k = end;
  }
}

double Branches::calc_event_function(const State& state, const Environment& environment, int event_function) const {
  const auto k = static_cast<std::size_t>(event_function);
  if (!unknowns_.is_active(state, event_functions_[k].member)) return 0;
  const std::size_t member = event_functions_[k].member,
                    begin = k - static_cast<std::size_t>(event_functions_[k].index);
  std::size_t end = k;
  while (end < event_functions_.size() && event_functions_[end].member == member) ++end;
  VectorX values(static_cast<Eigen::Index>(end - begin));
  model_.members()[member].component->calc_event_functions(local(state, member, environment), values);
  return values[event_functions_[k].index];
}

void Branches::do_actions(State& state, const Environment& environment, const std::vector<int>& ascending) const {
  std::vector<int> own;
  for (auto next = ascending.begin(); next != ascending.end();) {
    const std::size_t m = event_functions_[static_cast<std::size_t>(*next)].member;
    own.clear();
    for (; next != ascending.end() && event_functions_[static_cast<std::size_t>(*next)].member == m; ++next)
      own.push_back(event_functions_[static_cast<std::size_t>(*next)].index);
    if (const auto* actions = dynamic_cast<const EventActions*>(model_.members()[m].component.get()))
      actions->act(local(state, m, environment), own, ReferencedMemory(state.memory, unknowns_.slots()[m]));
  }
}

/// @param act  takes a component, its state and its new memory
template <class Act>
void Branches::for_each_activated(State& state, const Environment& environment, const VectorX& before,
                                  const Act& act) const {
  const Activities& activities = unknowns_.activities();
  if (!activities.any()) return;
  VectorX memory = state.memory;
  for (const std::size_t m : remembering_) {
    const Slots& slots = unknowns_.slots()[m];
    if (!unknowns_.is_active(state, m) || activities.is_active(before, unknowns_.slots(), m)) continue;
    act(*model_.members()[m].component, local(state, m, environment),
        memory.segment(slots.memory_begin, slots.memories));
  }
  state.memory = memory;
}

void Branches::accept_activated(State& state, const Environment& environment, const VectorX& before) const {
  for_each_activated(state, environment, before,
                     [](const Component& component, const LocalState& view, Eigen::Ref<VectorX> memory) {
                       component.accept(view, memory);
                     });
}

void Branches::begin(State& state, const Environment& environment, const std::vector<int>& crossed) const {
  std::vector<int> ascending = crossed, own;  // ordered by member, as the event functions are
  std::sort(ascending.begin(), ascending.end());
  VectorX memory = state.memory;
  do_actions(state, environment, ascending);
  for_each_activated(state, environment, memory,
                     [](const Component& component, const LocalState& view, Eigen::Ref<VectorX> own_memory) {
                       component.activate(view, own_memory);
                     });
  memory = state.memory;
  auto next = ascending.begin();
  for (const std::size_t m : remembering_) {
    own.clear();
    for (; next != ascending.end() && event_functions_[static_cast<std::size_t>(*next)].member <= m; ++next)
      if (const MemberEventFunction& event = event_functions_[static_cast<std::size_t>(*next)]; event.member == m)
        own.push_back(event.index);
    const Slots& slots = unknowns_.slots()[m];
    auto own_memory = memory.segment(slots.memory_begin, slots.memories);
    try {
      model_.members()[m].component->begin_branch(local(state, m, environment), own, own_memory);
    } catch (const ComputationError&) {
      if (unknowns_.is_active(state, m)) throw;  // a released part may be anywhere, see accept
      own_memory = local(state, m, environment).memory();
    }
  }
  state.memory = memory;
}

void Branches::begin_motion(State& state, const Environment& environment, bool known) const {
  VectorX memory = state.memory;
  for (const std::size_t m : remembering_) {
    const Slots& slots = unknowns_.slots()[m];
    model_.members()[m].component->begin_motion(local(state, m, environment), known,
                                                memory.segment(slots.memory_begin, slots.memories));
  }
  state.memory = memory;
}

bool Branches::accept(State& state, const Environment& environment) const {
  thread_local VectorX accepted;
  accepted = state.memory;
  VectorX& memory = accepted;  // all threads use the buffer of the calling thread
  std::atomic<bool> left = false;
  const auto accept_one = [&](std::size_t m) {
    const Component& component = *model_.members()[m].component;
    const Slots& slots = unknowns_.slots()[m];
    const LocalState view = local(state, m, environment);
    if (unknowns_.is_active(state, m) && component.leaves_branch(view)) left = true;
    try {
      component.accept(view, memory.segment(slots.memory_begin, slots.memories));
    } catch (const ComputationError&) {
      // A released part may be anywhere, also where it cannot be evaluated. It then keeps its memory.
      if (unknowns_.is_active(state, m)) throw;
      memory.segment(slots.memory_begin, slots.memories) = view.memory();
    }
  };
  const auto accept_costly = [&](std::size_t k) {
    if (unknowns_.slots()[work_.costly()[k]].memories > 0) accept_one(work_.costly()[k]);
  };
  work_.share(accept_costly, [&] {
    for (const std::size_t m : remembering_)
      if (!work_.is_costly(m)) accept_one(m);
  });
  state.memory.swap(memory);
  return left;
}

}  // namespace bielle::mechanism
