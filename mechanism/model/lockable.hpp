// Interface of components whose present value events lock and unlock: the opening of a valve.
//
// Actions of events write the value that is kept and the command to the component's memory; the component follows the
// command when its next branch begins.
#pragma once

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class Lockable {
 public:
  virtual ~Lockable() = default;
  /// Index in the component's memory of the command of events: 1 locks, -1 unlocks, 0 stands there before both.
  virtual int lock_command_place() const = 0;
  /// Index in the component's memory of the value that a lock keeps.
  virtual int locked_value_place() const = 0;
  /// Returns the present value, which a lock would keep. @param state  state of the component
  virtual double present_value(const LocalState& state) const = 0;
};

}  // namespace bielle::mechanism
