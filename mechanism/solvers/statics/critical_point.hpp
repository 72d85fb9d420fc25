// Change of stability along equilibria.
#pragma once

#include <string>

namespace bielle::mechanism {

/// A point at which the number of motions of negative stiffness changes along a path of equilibria: a limit point or
/// bifurcation.
struct CriticalPoint {
  double factor = 0;          ///< load factor, accurate to 1e-6 of the step
  int before = 0, after = 0;  ///< number of motions of negative stiffness
  std::string motion;         ///< unknown with the largest part in the critical motion: "x at node 'tip'"
  bool left = false;          ///< whether a branch was followed from there
};

}  // namespace bielle::mechanism
