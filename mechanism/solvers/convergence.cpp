#include "mechanism/solvers/convergence.hpp"

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
}

bool Convergence::reached(const Eigen::Ref<const VectorX>& r, const ResidualScale& scale) {
  worst_ = -1;
  worst_ratio_ = 0;
  const double force = std::max(scale[Kind::translation], scale[Kind::rotation]);
  for (int i = 0; i < system_.size(); ++i) {
    const Kind kind = system_.kind(i);
    const double reference = kind == Kind::multiplier ? force / scale_ : scale[kind];
    const double allowed = options_.tolerance * reference + floor_[i];
    const double residual = std::abs(r[i]);
    const double ratio = residual == 0 ? 0 : residual / allowed;
    if (ratio > worst_ratio_ || !std::isfinite(residual)) {
      worst_ratio_ = ratio;
      worst_ = i;
      worst_residual_ = r[i];
      if (!std::isfinite(residual)) return false;
    }
  }
  return worst_ratio_ <= 1;
}

std::string Convergence::worst() const {
  if (worst_ < 0) return "none";
  if (!std::isfinite(worst_residual_))
    return fmt::format("{}, which is beyond all numbers (overflow)", system_.equation_name(worst_));
  return fmt::format("{} ({:.2g} {})", system_.equation_name(worst_), worst_residual_, system_.equation_units(worst_));
}

}  // namespace bielle::mechanism
