// The clock of a sampled block: the sampling instants first + k*period, and the instants, `delay` later, at which its
// outputs change.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "mechanism/model/sampler.hpp"

namespace bielle::mechanism {

struct SampleClock {
  double first = 0;   ///< first instant [s] >= 0
  double period = 1;  ///< [s] > 0
  double delay = 0;   ///< from an instant to the change of the outputs [s] >= 0, also longer than `period`

  /// Tells whether `now` has reached a time, up to rounding of the ends of steps.
  bool has_come(double time, double now) const {
    return now >= time - 1e-9 * period - 32 * std::numeric_limits<double>::epsilon() * std::abs(time);
  }
  double instant(double k) const { return first + k * period; }
  /// Returns the number of the first instant after `now`; an analysis may begin after several instants.
  double number_after(double now) const {
    double k = std::max(0.0, std::floor((now - first) / period));
    while (has_come(instant(k), now)) ++k;
    return k;
  }
  /// Returns the largest number of samples that wait for the end of their delay simultaneously.
  double most_waiting() const { return delay > 0 ? std::floor(delay / period) + 1 : 0; }
  std::vector<Sampler::Instants> instants() const {
    constexpr double rounding = 5e-10;  // less than that of has_come
    if (std::abs(std::remainder(delay, period)) <= rounding * period) return {{first, period}};
    return {{first, period}, {first + delay, period}};
  }
};

}  // namespace bielle::mechanism
