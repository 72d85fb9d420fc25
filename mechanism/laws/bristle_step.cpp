#include "mechanism/laws/bristle_step.hpp"

namespace bielle::mechanism {

BristleStep::BristleStep(const FrictionLaw& law, const Vector3& before, const Vector3& slip, double h) {
  const double s = slip.norm(), sigma_0 = law.bristle_stiffness;
  const auto [mu, mu_slope] = law.level(s);  // mu'/s
  const auto [sigma_1, sigma_1_slope] = law.bristle_damping_at(s);
  const double m = s / mu, m_slope = 1 / mu - s * s * mu_slope / (mu * mu);
  const double D = 1 + h * sigma_0 * m, G = sigma_0 * (1 - sigma_1 * m) / D, H = G * h + sigma_1 + law.viscous;
  z = (before + h * slip) / D;
  force = G * before + H * slip;
  by_before = G;
  by_slip = H * Matrix3::Identity();
  if (s > 0) {
    const double G_slope = -sigma_0 * (sigma_1_slope * s * m + sigma_1 * m_slope + G * h * m_slope) / D;
    by_slip += ((G_slope / s) * before + (G_slope * h / s + sigma_1_slope) * slip) * slip.transpose();
  }
  stored = sigma_0 * z.dot(slip - sigma_0 * m * z);
  lost = force.dot(slip) - stored;
}

}  // namespace bielle::mechanism
