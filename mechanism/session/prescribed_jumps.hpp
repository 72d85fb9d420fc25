// Prescribed motions whose rate jumps, as that of a table does at its corners: bodies are stopped or set going there by
// impulses, which no machine gives and which no force in the results shows.
#pragma once

#include <string>
#include <vector>

#include "mechanism/solvers/dynamics/time_integration.hpp"

namespace bielle::mechanism {

class PrescribedJumps {
 public:
  /// Takes note of a discontinuity of a motion, where a prescribed rate jumps at it.
  void add(const System& system, const Jump& jump);
  /// The user should read this sentence at the end of a run; there may be none. @param largest  energy in the run [J]
  std::vector<std::string> doubts(double largest) const;

 private:
  std::vector<double> jumps_;    ///< of the energy, or the work of the impulse [J]
  std::string whose_;            ///< of the first, "drive 'lift'"
  double first_ = 0, work_ = 0;  ///< its time [s], and the work of its impulse [J]
};

}  // namespace bielle::mechanism
