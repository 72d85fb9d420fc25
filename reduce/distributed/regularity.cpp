#include "reduce/distributed/regularity.hpp"

#include <cmath>

namespace bielle::reduce {

namespace {

/// If the relative stiffness of the interior against some motion is below this, only rounding resists the motion.
constexpr double singular = 1e-15;

}  // namespace

std::optional<Eigen::Index> unresisted_unknown(const Factor& factor, const Eigen::VectorXd& scale, bool suspected) {
  Eigen::VectorXd motion(scale.size());
  for (Eigen::Index k = 0; k < motion.size(); ++k) motion(k) = (k * 7919 + 13) % 101 < 50 ? 1 : -1;
  double growth = 0;
  for (int step = 0; step < 2; ++step) {
    motion.normalize();
    motion = Eigen::VectorXd(scale.cwiseProduct(Eigen::VectorXd(factor.solve(scale.cwiseProduct(motion)))));
    growth = motion.norm();
  }
  if (!suspected && std::isfinite(growth) && growth < 1 / singular) return {};
  Eigen::Index unknown = 0;
  motion.cwiseAbs().maxCoeff(&unknown);
  return unknown;
}

}  // namespace bielle::reduce
