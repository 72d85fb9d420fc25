#include "mechanism/joints/flexible/hertz_contact.hpp"

#include <cmath>
#include <numbers>

namespace bielle::mechanism {
namespace {

struct EllipticIntegrals {
  double first, second;
};

EllipticIntegrals complete_integrals(double ratio) {
  const double modulus = std::sqrt(1 - 1 / (ratio * ratio));
  return {std::comp_ellint_1(modulus), std::comp_ellint_2(modulus)};
}

/// Returns the difference of curvatures that belongs to a ratio of the axes.
double curvature_difference(double ratio) {
  const auto [first, second] = complete_integrals(ratio);
  const double square = ratio * ratio;
  return ((square + 1) * second - 2 * first) / ((square - 1) * second);
}

}  // namespace

double hertz_constant(double R_x, double R_y, double modulus) {
  const double sum = 1 / R_x + 1 / R_y, difference = std::abs(1 / R_x - 1 / R_y) / sum;
  double ratio = 1;
  constexpr double circular = 1e-4;  // below this, a ratio of 1 is used: the error of the constant is about the square
  if (difference > circular) {
    double low = 1 + 1e-6, high = 2;
    while (curvature_difference(high) < difference) high *= 2;
    while (high - low > 1e-14 * high) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      (curvature_difference(middle) < difference ? low : high) = middle;
    }
    ratio = high;
  }
  const auto [first, second] = complete_integrals(ratio);
  return std::numbers::pi * ratio * modulus * std::sqrt(second / (4.5 * sum * first * first * first));
}

}  // namespace bielle::mechanism
