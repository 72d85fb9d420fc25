// Which instants of a motion go to the sinks.
#pragma once

#include <vector>

namespace bielle::mechanism {

struct Recording {
  int every = 1;  ///< steps between records; the first and the last are always recorded
  /// [s], ascending: if any, motions and kinematics record their start and these times in place of steps.
  std::vector<double> times;
  int checkpoint = 0;  ///< steps between points that a run can go on from; 0: at the end of motions only
  /// Ascending: if any, static analyses meet these load factors and record them alone, and limit points of paths.
  std::vector<double> load_factors = {};
};

}  // namespace bielle::mechanism
