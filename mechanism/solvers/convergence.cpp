#include "mechanism/solvers/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "mechanism/solvers/model_length.hpp"

namespace bielle::mechanism {

void Convergence::measure_rounding(const LinearStep& linear, const State& state) {
  const int n = system_.size();
  const double length = model_length(state);
  const auto largest = [](const VectorX& v) { return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0.0; };
  const double amplitude = largest(state.amplitude), first_order = largest(state.first_order),
               multiplier = largest(state.multiplier);
  unknown_scale_.resize(n);
  for (int i = 0; i < n; ++i) switch (system_.kind(i)) {
      case Kind::translation:
        unknown_scale_[i] = length;
        break;
      case Kind::rotation:
        unknown_scale_[i] = 1;
        break;
      case Kind::amplitude:
        unknown_scale_[i] = amplitude;
        break;
      case Kind::first_order:
        unknown_scale_[i] = first_order;
        break;
      case Kind::multiplier:
        unknown_scale_[i] = multiplier;
        break;
    }
  floor_.resize(n);
  linear.row_sums(unknown_scale_, floor_);
  // Rounding of a sum of some ten terms.
  floor_ *= 10 * std::numeric_limits<double>::epsilon();
  scale_ = linear.scale();
  measured_ = false;
}

std::array<double, kind_count> Convergence::tolerances(const ResidualScale& scale) const {
  std::array<double, kind_count> result = scale.largest;
  result[static_cast<std::size_t>(Kind::multiplier)] =
      std::max(scale[Kind::translation], scale[Kind::rotation]) / scale_;
  for (double& value : result) value *= options_.tolerance;
  return result;
}

bool Convergence::reached(const Eigen::Ref<const VectorX>& r, const ResidualScale& scale) {
  worst_ = -1;
  worst_ratio_ = worst_residual_ = 0;
  const std::array<double, kind_count> allowed = tolerances(scale);
  for (int i = 0; i < system_.size(); ++i) {
    const double residual = std::abs(r[i]);
    // Only what may be worse than the worst so far is divided.
    const double most = allowed[static_cast<std::size_t>(system_.kind(i))] + floor_[i];
    if (residual == 0 || residual <= worst_ratio_ * most) continue;
    worst_ratio_ = residual / most;
    worst_ = i;
    worst_residual_ = r[i];
    if (!std::isfinite(residual)) return false;
  }
  return worst_ratio_ <= 1;
}

bool Convergence::out_of_reach(double size, const ResidualScale& scale) const {
  if (!measured_) return false;
  const std::array<double, kind_count> allowed = tolerances(scale);
  double growth = 1;  // of the tolerances since
  for (std::size_t k = 0; k < kind_count; ++k)
    if (allowed[k] > measured_by_[k] * growth) growth = allowed[k] / measured_by_[k];
  constexpr double rounding = 1e-9;
  return size > growth * (1 + rounding);
}

void Convergence::measure_by(const ResidualScale& scale) {
  const std::array<double, kind_count> allowed = measured_by_ = tolerances(scale);
  measure_.resize(system_.size());
  for (int i = 0; i < system_.size(); ++i) {
    const double most = allowed[static_cast<std::size_t>(system_.kind(i))] + floor_[i];
    // What is allowed less than the least normal number counts for nothing: its inverse would be none.
    measure_[i] = most > std::numeric_limits<double>::min() ? 1 / most : 0;
  }
  measured_ = true;
}

double Convergence::size_of(const Eigen::Ref<const VectorX>& r) const {
  if (r.size() == 0) return 0;
  const double size = measure_.cwiseProduct(r.cwiseAbs()).maxCoeff<Eigen::PropagateNaN>();
  return std::isfinite(size) ? size : std::numeric_limits<double>::infinity();
}

std::string Convergence::worst() const {
  if (worst_ < 0) return "none";
  if (!std::isfinite(worst_residual_))
    return fmt::format("{}, which is beyond all numbers (overflow)", system_.equation_name(worst_));
  return fmt::format("{} ({:.2g} {})", system_.equation_name(worst_), worst_residual_, system_.equation_units(worst_));
}

}  // namespace bielle::mechanism
