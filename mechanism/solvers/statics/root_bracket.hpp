// Two places between which a function changes its sign, which converge by regula falsi after Illinois (M. Dowell, P.
// Jarratt, BIT 11 (1971) 168): the weight of an end that is retained twice is halved.
#pragma once

#include <algorithm>
#include <cmath>

namespace bielle::mechanism {

class RootBracket {
 public:
  /// @param low,high  places in either order; @param at_low,at_high  values of the function there
  RootBracket(double low, double at_low, double high, double at_high)
      : low_(low), high_(high), at_low_(at_low), at_high_(at_high) {}

  double low() const { return low_; }
  double width() const { return std::abs(high_ - low_); }
  double slope() const { return (at_high_ - at_low_) / (high_ - low_); }
  /// Zero of the straight line between the ends.
  double interpolated() const { return (low_ * at_high_ - high_ * at_low_) / (at_high_ - at_low_); }
  /// Returns this zero, or the middle if the ends have the same sign, but no closer to an end than the margin, where
  /// the bracket would hardly shrink.
  double next(double margin) const {
    const double place = at_low_ * at_high_ < 0 ? interpolated() : 0.5 * (low_ + high_);
    const double within = high_ < low_ ? -margin : margin;
    return std::clamp(place, std::min(low_ + within, high_ - within), std::max(low_ + within, high_ - within));
  }
  /// Replaces one of the ends by a place between them and its value.
  void replace(bool low, double place, double value) {
    (low ? low_ : high_) = place;
    (low ? at_low_ : at_high_) = value;
    const int side = low ? 1 : -1;
    if (side_ == side) (low ? at_high_ : at_low_) /= 2;
    side_ = side;
  }

 private:
  double low_, high_, at_low_, at_high_;
  int side_ = 0;  ///< which end was replaced last
};

}  // namespace bielle::mechanism
