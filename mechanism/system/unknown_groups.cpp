#include "mechanism/system/unknown_groups.hpp"

namespace bielle::mechanism {

std::vector<int> unknown_groups(const System& system, int count) {
  std::vector<int> group(static_cast<std::size_t>(count));
  int groups = 0;
  for (int i = 0; i < count; ++i) {
    const bool goes_on = i > 0 && i < system.kinematics().unknowns() && system.kind(i) == system.kind(i - 1) &&
                         system.kinematics().node_of(i) == system.kinematics().node_of(i - 1);
    group[static_cast<std::size_t>(i)] = goes_on ? groups - 1 : groups++;
  }
  return group;
}

}  // namespace bielle::mechanism
