// Smooth transitions of openings, with two continuous derivatives.
#pragma once

#include "mechanism/math/smooth_step.hpp"

namespace bielle::mechanism {

struct Opening {
  double value, slope;
};

/// Returns the opening of an edge: 0 for x <= 0, x for x >= width, and x (6 u - 8 u^2 + 3 u^3) u with u = x/width
/// between them.
inline Opening edge_opening(double x, double width) {
  if (x <= 0) return {0, 0};
  if (x >= width) return {x, 1};
  const double u = x / width;
  return {width * u * u * u * (6 - u * (8 - 3 * u)), u * u * (18 - u * (32 - 15 * u))};
}

/// Returns the opening of a poppet, from its seat to its end: 0 for x <= 0, 1 for x >= 1, and 10 x^3 - 15 x^4 + 6 x^5
/// between them.
inline Opening poppet_opening(double x) {
  const SmoothStep step = smooth_step(x);
  return {step.value, step.slope};
}

}  // namespace bielle::mechanism
