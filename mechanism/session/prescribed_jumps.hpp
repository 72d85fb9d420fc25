// Prescribed motions whose rate jumps, like that of a table at its corners. Impulses stop or accelerate the bodies
// there: a real machine cannot exert them, and they are not visible as forces in the results.
#pragma once

#include <string>
#include <vector>

#include "mechanism/solvers/dynamics/time_integration.hpp"

namespace bielle::mechanism {

class PrescribedJumps {
 public:
  /// Records a discontinuity of a motion at which a prescribed rate jumps.
  void add(const System& system, const Jump& jump);
  /// Returns a warning for the end of a run, or none. @param largest  largest energy in the run [J]
  std::vector<std::string> warnings(double largest) const;

 private:
  std::vector<double> jumps_;    ///< change of the energy, or work of the impulse [J]
  std::string whose_;            ///< component of the first jump, "drive 'lift'"
  double first_ = 0, work_ = 0;  ///< its time [s], and the work of its impulse [J]
};

}  // namespace bielle::mechanism
