// The corners of the four-bar that tests release under gravity.
#pragma once

#include <cmath>

#include "mechanism/math/types.hpp"

namespace bielle::test {

/// Crank A B, coupler B C, rocker D C, in the plane x-y [m].
struct FourBar {
  mechanism::Vector3 A, B, C, D;
};

/// Returns a four-bar with ground 1, crank 0.3 at 60 degrees, coupler 0.9, rocker 0.7 m; the open branch.
inline FourBar released_four_bar() {
  using mechanism::Vector3;
  const double a = M_PI / 3;
  const Vector3 A(0, 0, 0), D(1, 0, 0), B(0.3 * std::cos(a), 0.3 * std::sin(a), 0);
  const Vector3 BD = D - B;
  const double distance = BD.norm(), along = (0.81 - 0.49 + distance * distance) / (2 * distance);
  const Vector3 e = BD / distance, n(-e.y(), e.x(), 0);
  return {A, B, B + along * e + std::sqrt(0.81 - along * along) * n, D};
}

}  // namespace bielle::test
