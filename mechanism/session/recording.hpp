// Which instants of a motion go to the sinks.
#pragma once

#include <vector>

namespace bielle::mechanism {

struct Recording {
  int every = 1;  ///< steps between records; the first and the last are always recorded
  /// [s], ascending: if any, motions record their start and these times in place of steps.
  std::vector<double> times;
  int checkpoint = 0;  ///< steps between points that a run can go on from; 0: at the end of motions only
};

}  // namespace bielle::mechanism
