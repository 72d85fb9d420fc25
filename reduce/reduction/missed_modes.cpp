#include "reduce/reduction/missed_modes.hpp"

#include <cmath>
#include <numbers>

namespace bielle::reduce {

namespace {

/// No shift is placed between modes closer than this: rounding in the pivots moves eigenvalues by about 1e-12, and
/// growth multiplies that.
constexpr double least_gap = 1e-4;
constexpr double most_growth = 1e6;
constexpr int most_trials = 3;

}  // namespace

std::optional<ModeCount> count_modes(const BodyMatrices& matrices, const FixedInterfaceBody& held, const Basis& basis) {
  const Eigen::Index found = basis.modes() - basis.residual_vectors;
  int trials = 0;
  for (Eigen::Index k = found; k > 0; --k) {
    const double last = basis.eigenvalues(k - 1);
    const std::optional<double> next = k < found ? basis.eigenvalues(k) : basis.next;
    // If the next one is unknown, the shift is slightly above the last, where no further mode is expected.
    const double gap = next ? *next - last : 0.01 * last;
    if (gap < least_gap * last) continue;
    for (const double part : {0.5, 0.7}) {
      const double shift = last + part * gap;
      const std::optional<PivotSigns> signs = held.count_below(matrices, shift);
      if (!signs) return std::nullopt;
      if (signs->growth < most_growth)
        return ModeCount{std::sqrt(shift) / (2 * std::numbers::pi), k, signs->negative, signs->growth};
      if (++trials == most_trials) return std::nullopt;
    }
  }
  return std::nullopt;
}

}  // namespace bielle::reduce
