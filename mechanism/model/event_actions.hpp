// Components that change the memory of others when one of their own events occurs: inputs, locks, activities.
//
// All actions of an instant are done before any component begins its new branch, one after the other in the order of
// the components and within one in its own order. The branches then begin from the state with all actions done.
#pragma once

#include <cstddef>
#include <span>

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

/// The memory that a component may change when its events occur: its own, and that of the components referred to.
class ReferencedMemory {
 public:
  ReferencedMemory(VectorX& memory, const Slots& slots) : memory_(memory), slots_(slots) {}
  /// Memory of the k-th component referred to.
  Eigen::Map<VectorX> of(int k) const {
    const Slots& other = *slots_.references[static_cast<std::size_t>(k)];
    return {memory_.data() + other.memory_begin, other.memories};
  }

 private:
  VectorX& memory_;
  const Slots& slots_;
};

class EventActions {
 public:
  virtual ~EventActions() = default;
  /// Does the actions of own events that have occurred.
  /// @param state    state just before; its memory already has the changes of earlier actions of the same instant
  /// @param crossed  numbers of the component's own event functions that crossed zero, at least one
  virtual void act(const LocalState& state, std::span<const int> crossed, const ReferencedMemory& memory) const = 0;
  /// Returns whether there is anything to do, be it to count.
  virtual bool has_actions() const = 0;
  /// Returns whether actions may switch constraints or forces on or off: only a motion with inertia follows them.
  virtual bool switches_parts() const = 0;
};

}  // namespace bielle::mechanism
