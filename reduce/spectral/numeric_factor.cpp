#include "reduce/spectral/numeric_factor.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "reduce/spectral/symmetric_factor.hpp"

namespace bielle {

namespace {

template <class Number>
ZeroNumbers<Number> factorised(const FactorStructure& structure, const Multifrontal& elimination, const BorderedPart& a,
                               std::span<const double> scale) {
  ZeroNumbers<Number> values(static_cast<std::size_t>(structure.values()));
  const std::optional<std::int64_t> failed = elimination.factorise(a, scale, values.get());
  if (failed) throw NotPositiveDefinite(structure.supernodes().order[*failed]);
  return values;
}

template <class Number>
Pivots find_pivots(const SupernodalFactor& factor, const Number* values, std::span<const double> diagonal) {
  Pivots result;
  double least = std::numeric_limits<double>::infinity(), largest = 0;
  for (std::int64_t s = 0; s < factor.supernodes; ++s) {
    const std::int64_t rows = factor.row_starts[s + 1] - factor.row_starts[s];
    for (std::int64_t k = 0; k < factor.columns[s + 1] - factor.columns[s]; ++k) {
      const std::int64_t unknown = factor.order[factor.columns[s] + k];
      const double root = values[factor.value_starts[s] + k * (rows + 1)], pivot = root * root;
      least = std::min(least, pivot);
      largest = std::max(largest, pivot);
      const double relative = pivot / diagonal[static_cast<std::size_t>(unknown)];
      if (!(relative >= result.relative)) {
        result.unknown = unknown;
        result.relative = relative;
      }
    }
  }
  result.least_over_largest = least / largest;
  return result;
}

}  // namespace

template <class Number>
NumericFactor<Number>::NumericFactor(const FactorStructure& structure, const Multifrontal& elimination,
                                     const BorderedPart& a, std::span<const double> scale,
                                     std::span<const double> diagonal, int threads)
    : values_(factorised<Number>(structure, elimination, a, scale)),
      pivots_(find_pivots(structure.supernodes(), values_.get(), diagonal)),
      solver_(structure.supernodes(), values_.get(), threads) {}

template class NumericFactor<double>;
template class NumericFactor<float>;

}  // namespace bielle
