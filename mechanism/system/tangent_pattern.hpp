// The pattern of a system's tangent, with its parts that are condensed before a factorisation.
#pragma once

#include <utility>
#include <vector>

#include "mechanism/math/condensed.hpp"

namespace bielle::mechanism {

/// The object is constant: a tangent with entries at other places has another one.
struct TangentPattern {
  /// @param amplitudes  amplitudes of each component that couple only to its own unknowns, ascending
  TangentPattern(SparsePattern pattern, const std::vector<std::vector<int>>& amplitudes)
      : whole(std::move(pattern)), condensed(whole, amplitudes) {}
  TangentPattern(const TangentPattern&) = delete;
  TangentPattern& operator=(const TangentPattern&) = delete;

  const SparsePattern whole;
  const CondensedPattern condensed;
};

}  // namespace bielle::mechanism
