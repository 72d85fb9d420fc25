// Angles counted over turns.
#pragma once

#include <cmath>

#include "mechanism/measures/coordinate.hpp"
#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

/// Returns `angle` plus the whole turns that bring it closest to `previous`.
double unwrap_angle(double angle, double previous);

/// Returns an angle with the number of whole turns predicted from the last accepted step and the rates, so that a step
/// may rotate by more than half a turn. Before the first step (`time_before` is NaN), the prediction is the start value
/// times the fraction of motions applied by statics.
/// @param principal  angle in (-pi, pi], with its rate   @param before  the counted angle and rate of the last accepted
///                   step
inline double counted_angle(const CoordinateRate& principal, const CoordinateRate& before, double time_before,
                            const LocalState& state) {
  const double expected = std::isnan(time_before)
                              ? state.motion_factor() * before.value
                              : before.value + 0.5 * (before.rate + principal.rate) * (state.time() - time_before);
  return unwrap_angle(principal.value, expected);
}

}  // namespace bielle::mechanism
