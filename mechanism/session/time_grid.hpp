// Equal steps that fill a duration.
#pragma once

#include <algorithm>
#include <cmath>

namespace bielle::mechanism {

/// How many, of at most the asked size. @param duration,step  [s] > 0
inline long grid_steps(double duration, double step) {
  constexpr double rounding = 1e-12;
  return std::max(1L, std::lround(std::ceil(duration / step * (1 - rounding))));
}

}  // namespace bielle::mechanism
