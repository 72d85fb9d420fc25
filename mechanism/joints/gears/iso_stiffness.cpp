#include "mechanism/joints/gears/iso_stiffness.hpp"

#include <cmath>

namespace bielle::mechanism {
namespace {

double involute(double angle) { return std::tan(angle) - angle; }

/// Solves inv(angle) = value. Newton's method: inv' = tan^2; from the right, where inv is convex, it is monotone.
double inverse_involute(double value) {
  double angle = std::cbrt(3 * value);
  if (angle > 1.2) angle = 1.2;
  for (int k = 0; k < 50; ++k) {
    const double change = (involute(angle) - value) / (std::tan(angle) * std::tan(angle));
    angle -= change;
    if (std::abs(change) < 1e-15) break;
  }
  return angle;
}

}  // namespace

double transverse_contact_ratio(const CylindricalTeeth& pair) {
  // Lengths in units of the transverse module.
  const double cosine = std::cos(pair.helix), transverse = std::atan(std::tan(pair.pressure_angle) / cosine);
  const double sum = pair.teeth[0] + pair.teeth[1];
  const double working = inverse_involute(involute(transverse) +
                                          2 * std::tan(pair.pressure_angle) * (pair.shifts[0] + pair.shifts[1]) / sum);
  const double base = std::cos(transverse), distance = 0.5 * sum * base / std::cos(working);
  double path = -distance * std::sin(working);
  for (const std::size_t k : {0, 1}) {
    const double tip = 0.5 * pair.teeth[k] + cosine * (1 + pair.shifts[k]), root = 0.5 * pair.teeth[k] * base;
    path += std::sqrt(tip * tip - root * root);
  }
  return path / (M_PI * base);
}

IsoStiffness iso_stiffness(const CylindricalTeeth& pair, double contact_ratio) {
  const double cosine = std::cos(pair.helix), inclined = std::sin(pair.helix) * std::cos(pair.pressure_angle);
  const double base = 1 - inclined * inclined;  // cos(beta_b)^2
  const double inverse_1 = base * cosine / pair.teeth[0], inverse_2 = pair.ring ? 0 : base * cosine / pair.teeth[1];
  const auto [x_1, x_2] = pair.shifts;
  const double q = 0.04723 + 0.15551 * inverse_1 + 0.25791 * inverse_2 - 0.00635 * x_1 - 0.11654 * x_1 * inverse_1 -
                   0.00193 * x_2 - 0.24188 * x_2 * inverse_2 + 0.00529 * x_1 * x_1 + 0.00182 * x_2 * x_2;
  const double degrees = pair.pressure_angle * 180 / M_PI;
  const double rack = (1 + 0.5 * (1.2 - pair.dedendum)) * (1 - 0.02 * (20 - degrees));
  const double single = 1e9 * 0.8 * pair.blank * rack * cosine * (pair.young / 206e9) / q;
  const double mesh = single * (0.75 * contact_ratio + 0.25);
  return {single, mesh, pair.width * mesh / base};
}

}  // namespace bielle::mechanism
