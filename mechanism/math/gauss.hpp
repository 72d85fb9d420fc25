// Gauss quadrature on [0, 1] by three points: exact for polynomials of degree five.
#pragma once

#include <array>

namespace bielle::mechanism {

struct Gauss3 {
  static constexpr std::array<double, 3> place{0.1127016653792583, 0.5, 0.8872983346207417};
  static constexpr std::array<double, 3> weight{5.0 / 18, 8.0 / 18, 5.0 / 18};
};

}  // namespace bielle::mechanism
