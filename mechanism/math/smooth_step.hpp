// A step with two continuous derivatives.
#pragma once

namespace bielle::mechanism {

struct SmoothStep {
  double integral;  ///< integral of the value from 0 to x
  double value, slope;
};

/// 0 for x <= 0, 1 for x >= 1, between them 10 x^3 - 15 x^4 + 6 x^5.
inline SmoothStep smooth_step(double x) {
  if (x <= 0) return {0, 0, 0};
  if (x >= 1) return {x - 0.5, 1, 0};
  const double x3 = x * x * x;
  return {x3 * x * (2.5 - x * (3 - x)), x3 * (10 - x * (15 - 6 * x)), 30 * x * x * (1 - x) * (1 - x)};
}

}  // namespace bielle::mechanism
