// Lock of a valve's opening, which events close and open; its state is in the memory of the valve.
//
// A locked valve keeps its opening, and the dynamics of its spool or poppet are suspended: first-order unknowns have
// rates of zero. A spool of second order starts from rest when it is unlocked: its speed w counts from the value w_0
// that it had when it was locked.
#pragma once

#include <cmath>
#include <vector>

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class OpeningLock {
 public:
  /// Indices in the memory: whether the valve has begun its first motion, the command of events (1 locks, -1 unlocks),
  /// whether the opening is locked, the opening that is kept, and w_0.
  enum Place : Eigen::Index { begun, command, locked, opening, speed };
  static std::vector<double> start_memory() { return {0, 0, 0, 0, 0}; }

  static bool is_locked(const LocalState& valve) { return valve.memory()[locked] != 0; }
  static double kept_opening(const LocalState& valve) { return valve.memory()[opening]; }
  static double kept_speed(const LocalState& valve) { return valve.memory()[speed]; }

  /// Follows the command of events at the beginning of a branch. @param w  present speed of the spool
  static void follow(double w, Eigen::Ref<VectorX> memory) {
    const bool locks = memory[command] > 0;
    if (locks && memory[locked] == 0) memory[speed] = w;
    memory[locked] = locks ? 1 : 0;
  }
  static bool knows(const Eigen::Ref<const VectorX>& memory) {
    const auto is_flag = [](double value) { return value == 0 || value == 1; };
    return is_flag(memory[begun]) && is_flag(std::abs(memory[command])) && is_flag(memory[locked]);
  }
};

}  // namespace bielle::mechanism
