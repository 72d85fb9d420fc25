// Divides a duration into equal steps.
#pragma once

#include <algorithm>
#include <cmath>

namespace bielle::mechanism {

/// Number of equal steps that are not larger than the requested size. @param duration,step  [s] > 0
inline long grid_steps(double duration, double step) {
  constexpr double rounding = 1e-12;
  return std::max(1L, std::lround(std::ceil(duration / step * (1 - rounding))));
}

}  // namespace bielle::mechanism
