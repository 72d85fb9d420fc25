// Interface of components whose values repeat those of earlier times of a motion: delays.
//
// A jump of the motion comes back with the delay. The component is told the values on both sides of each discontinuity,
// the one before it by `accept`, and it tells when the next jump comes back: a step ends there, and another branch of
// the motion begins.
#pragma once

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class Echo {
 public:
  virtual ~Echo() = default;
  /// Stores the values just after a discontinuity.
  /// @param state   consistent state of the component just after it
  /// @param time    time of the discontinuity [s]; that of the state is a little later
  /// @param memory  the component's own memory
  /// @throws ComputationError if it has no place left
  virtual void note_jump(const LocalState& state, double time, Eigen::Ref<VectorX> memory) const = 0;
  /// Returns the first time after `after` at which an earlier jump comes back [s]; infinity if none does.
  virtual double next_echo(const LocalState& state, double after) const = 0;
  /// Forgets the past. Small motions about a state have none: the component then passes the present values on.
  virtual void forget(Eigen::Ref<VectorX> memory) const = 0;
};

}  // namespace bielle::mechanism
