#include "reduce/reduction/missed_modes.hpp"

#include <cmath>
#include <numbers>

namespace bielle::reduce {

namespace {

/// Modes closer than this have no shift between them: rounding in the pivots moves eigenvalues by 1e-12 or so, growth
/// by as many times that.
constexpr double least_gap = 1e-4;
constexpr double most_growth = 1e6;
constexpr int most_trials = 3;

}  // namespace

std::optional<ModeCount> count_modes(const BodyMatrices& matrices, const HeldBody& held, const Basis& basis) {
  const Eigen::Index found = basis.modes() - basis.residual_vectors;
  int trials = 0;
  for (Eigen::Index k = found; k > 0; --k) {
    const double last = basis.eigenvalues(k - 1);
    const std::optional<double> next = k < found ? basis.eigenvalues(k) : basis.next;
    // Where nothing is known of the next one: not far above the last, where there is none yet.
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
