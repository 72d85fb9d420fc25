// Where stability changes along equilibria.
#pragma once

#include <string>

namespace bielle::mechanism {

/// Where the number of motions of negative stiffness changes along a path of equilibria: a limit point or bifurcation.
struct CriticalPoint {
  double factor = 0;          ///< load factor, found to 1e-6 of the step
  int before = 0, after = 0;  ///< motions of negative stiffness
  std::string motion;         ///< what moves most in the critical motion: "x at node 'tip'"
  bool left = false;          ///< a branch was followed from there
};

}  // namespace bielle::mechanism
