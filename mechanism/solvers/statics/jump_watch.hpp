// Increments of the load that jump: past a limit point of the load there is no equilibrium near, and Newton's method
// may find one far away, stable like the one before, without a word.
//
// An increment is suspected that moves the mechanism farther than a few times what the linear response to it promised.
// It is halved, and halved again where more of the motion is: a motion that stays at one place, however small the
// increment, is a jump.
#pragma once

#include <optional>

#include "mechanism/solvers/statics/equilibrium.hpp"
#include "mechanism/solvers/statics/statics.hpp"

namespace bielle::mechanism {

class JumpWatch {
 public:
  JumpWatch(const System& system, Equilibrium& equilibrium) : system_(system), equilibrium_(equilibrium) {}

  struct Point {
    double factor;
    State state;
  };
  /// @param from,to  two equilibria, the second just found by `equilibrium`; @returns the jump between them, if any
  std::optional<LoadJump> look(Point from, Point to);

 private:
  double distance(const State& from, const State& to, std::string* node = nullptr) const;
  const System& system_;
  Equilibrium& equilibrium_;
};

}  // namespace bielle::mechanism
