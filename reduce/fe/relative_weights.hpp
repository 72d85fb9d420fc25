// Weights of nodes relative to the largest: a tie takes their ratios alone, and moments of very large or very small
// ones would not be finite.
#pragma once

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::reduce {

/// @throws InputError unless the weights are positive and differ by a factor of 1e8 at most: smaller ones are no part
/// of a mean, and rotations of the tie would follow from rounding
inline std::vector<double> relative_weights(const std::vector<double>& weights) {
  constexpr double least_ratio = 1e-8;
  if (weights.empty()) return {};
  const auto [least, largest] = std::minmax_element(weights.begin(), weights.end());
  if (!(*least / *largest >= least_ratio))
    throw InputError(fmt::format(
        "its weights are between {:.3g} and {:.3g}: expected positive weights that differ by a factor of 1e8 "
        "at most; leave out the nodes of small weights",
        *least, *largest));
  std::vector<double> result;
  for (const double weight : weights) result.push_back(weight / *largest);
  return result;
}

}  // namespace bielle::reduce
