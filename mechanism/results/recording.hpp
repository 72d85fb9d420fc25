// Selects the instants of a motion that are sent to the sinks.
#pragma once

#include <vector>

namespace bielle::mechanism {

struct Recording {
  int every = 1;  ///< steps between records; the first and the last are always recorded
  /// Ascending times [s]: if there are any, motions and kinematics record their start and these times instead of steps.
  std::vector<double> times;
  int checkpoint = 0;  ///< steps between checkpoints; 0: only at the end of motions
  /// Ascending load factors: if there are any, static analyses stop at them, and record only them and limit points of
  /// paths.
  std::vector<double> load_factors = {};
};

}  // namespace bielle::mechanism
