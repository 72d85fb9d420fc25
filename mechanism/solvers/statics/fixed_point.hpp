// A fixed point x = G(x) by iteration that uses the last steps: D. G. Anderson, J. ACM 12 (1965) 547.
//
// With g = G(x) - x, and the changes dx, dg of x and g over the last iterations as columns X and Y,
//     x_next = x + g - (X + Y) c,   c minimises |g - Y c|.
// Directions that G contracts slowly, or not at all, converge as with a secant method, provided that they are few.
#pragma once

#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

class FixedPoint {
 public:
  /// @param weights  weights of the components of g in its norm
  explicit FixedPoint(VectorX weights) : weights_(std::move(weights)) {}
  /// @param image  G(x) @returns the next x
  VectorX next(const VectorX& x, const VectorX& image);

 private:
  VectorX weights_, x_, g_;
  std::vector<VectorX> dx_, dg_;  ///< the oldest first
};

}  // namespace bielle::mechanism
