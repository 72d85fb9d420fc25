#include "reduce/common/input/plausible.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace bielle {

void warn_outside(const YamlValue& place, double value, const PlausibleRange& range) {
  if (value < range.low || value > range.high) place.warn(fmt::format("is {:g} meant? {}", value, range.text));
}

namespace {

/// Returns the largest absolute value of a formula near its break points and between them. It scales the rounding
/// error, also where the formula vanishes (a sine after a full turn).
double largest_about(const Expression& formula, const std::vector<double>& break_points) {
  std::vector<double> times = break_points;
  for (std::size_t k = 1; k < break_points.size(); ++k)
    for (const double part : {0.13, 0.38, 0.62, 0.87})  // sines and cosines of whole turns have no zeros here
      times.push_back(break_points[k - 1] + part * (break_points[k] - break_points[k - 1]));
  double largest = 0;
  for (const double time : times) {
    try {
      largest = std::max(largest, std::abs(formula(time)));
    } catch (const ComputationError&) {  // it has no value there
    }
  }
  return largest;
}

}  // namespace

void warn_of_jumps(const YamlValue& place, const Expression& formula, const char* what) {
  const double rounding = 1e-12 * largest_about(formula, formula.break_points());
  for (const double time : formula.break_points()) {
    // At a smaller distance a jump keeps its size, but the change at a kink becomes smaller.
    const double near = 1e-8 * (1 + std::abs(time));
    const auto change = [&](double step) { return std::abs(formula(time + step) - formula(time - step)); };
    double wide = 0, narrow = 0;
    try {
      wide = change(near);
      narrow = change(0.1 * near);
    } catch (const ComputationError&) {  // on one side it has no value: a table begins or ends
      continue;
    }
    if (wide > std::max(rounding, 1e-12 * std::abs(formula(time + near))) && narrow > 0.5 * wide) {
      place.warn(
          fmt::format("{} jumps by {:.3g} at t = {:.6g} s; the motion there is what the steps make of it. `step` is "
                      "a smooth transition",
                      what, narrow, time));
      return;
    }
  }
}

}  // namespace bielle
