#include "mechanism/analyses/turning_response.hpp"

#include <numbers>

namespace bielle::mechanism {
namespace {

/// Returns the number of azimuths at which the means of products of the functions e_p, the unknowns, and inputs or
/// outputs are exact. Inputs and outputs have up to three harmonics, as coefficients have, in addition to those of the
/// motion.
int azimuths_for(int harmonics, const TurningEquations& turning) {
  return 2 * (harmonics + 4 + (turning.orbit ? turning.orbit->deviation.harmonics : 0));
}

}  // namespace

TurningResponse::TurningResponse(const System& system, const StandingState& about, const TurningEquations& turning,
                                 const LinearisedEquations& equations, int harmonics)
    : periodic_(turning.periodic),
      equations_(equations),
      harmonics_(harmonics),
      azimuths_(turning.azimuths(system, about, azimuths_for(harmonics, turning))) {
  for (const Azimuth& each : azimuths_) responses_.emplace_back(system, each.state, about.environment, each.equations);
}

double TurningResponse::azimuth(std::size_t k) const {
  return 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(azimuths_.size());
}

VectorX TurningResponse::right_side(const ResponseInput& input) const {
  const int n = azimuths_.front().equations.unknowns(), m = azimuths_.front().equations.constraints(),
            N = equations_.unknowns();
  VectorX right = VectorX::Zero(N + equations_.constraints());
  for (std::size_t k = 0; k < azimuths_.size(); ++k) {
    const VectorX here = responses_[k].right_side(input);
    const VectorX forces = azimuths_[k].axes.transpose() * here.head(n), gaps = azimuths_[k].rows * here.tail(m);
    for (int p = 0; p < 2 * harmonics_ + 1; ++p) {
      const double weight = PeriodicEquations::function(p, azimuth(k)) / static_cast<double>(azimuths_.size());
      for (int i = 0; i < n; ++i) right[periodic_.index(p, i, harmonics_)] += weight * forces[i];
      right.segment(N + p * m, m) += weight * gaps;
    }
  }
  // Sums over a whole turn that are only rounding errors would be inputs of harmonics that do not exist.
  constexpr double rounding = 1e-14;
  const double most = right.cwiseAbs().maxCoeff();
  return right.unaryExpr([=](double value) { return std::abs(value) > rounding * most ? value : 0.0; });
}

LinearMotion TurningResponse::at_azimuth(std::size_t k, const LinearMotion& motion) const {
  const int n = azimuths_.front().equations.unknowns(), m = azimuths_.front().equations.constraints();
  LinearMotion here{Eigen::VectorXcd::Zero(n), Eigen::VectorXcd::Zero(n), Eigen::VectorXcd::Zero(m)};
  for (int p = 0; p < 2 * harmonics_ + 1; ++p) {
    const double factor = PeriodicEquations::function(p, azimuth(k));
    for (int i = 0; i < n; ++i) {
      here.u[i] += factor * motion.u[periodic_.index(p, i, harmonics_)];
      here.rate[i] += factor * motion.rate[periodic_.index(p, i, harmonics_)];
    }
    here.multiplier += factor * motion.multiplier.segment(p * m, m);
  }
  here.u = (azimuths_[k].axes * here.u).eval();
  here.rate = (azimuths_[k].axes * here.rate).eval();
  here.multiplier = (azimuths_[k].rows.transpose() * here.multiplier).eval();
  return here;
}

Eigen::VectorXcd TurningResponse::values(const std::vector<ResponseOutput>& outputs, const LinearMotion& motion) const {
  Eigen::VectorXcd sum = Eigen::VectorXcd::Zero(static_cast<Eigen::Index>(outputs.size()));
  for (std::size_t k = 0; k < azimuths_.size(); ++k) sum += responses_[k].values(outputs, at_azimuth(k, motion));
  return sum / static_cast<double>(azimuths_.size());
}

double TurningResponse::direct(const ResponseOutput& output, const ResponseInput& input) const {
  double sum = 0;
  for (const SteadyResponse& each : responses_) sum += each.direct(output, input);
  return sum / static_cast<double>(azimuths_.size());
}

}  // namespace bielle::mechanism
