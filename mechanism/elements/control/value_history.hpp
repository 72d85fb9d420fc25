// The past of a value in a component's memory: the values at the ends of accepted steps over a time T, and
// interpolation between them.
//
// Between two stored times the value is the cubic of Hermite with slopes of parabolas through three neighbours (error
// of third order in their distance). From the last stored time to the present it is the parabola through the last two
// values and the present one, which is still unknown to the solver: the weight of the present value is returned. Values
// are kept at distances of T/points at least, so that the memory has a fixed size for steps of any size.
//
//     memory: [number of values | t_0, y_0, t_1, y_1, .. ascending]
#pragma once

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

class ValueHistory {
 public:
  /// @param span    T [s] > 0
  /// @param points  number of values over this time, at least 4
  ValueHistory(double span, int points) : span_(span), points_(points) {}
  std::size_t memory_size() const { return 1 + 2 * (static_cast<std::size_t>(points_) + 6); }

  /// A past value as constant + factor * present value.
  struct Past {
    double constant = 0, factor = 0;
  };
  /// Returns the value T before the present. Before the first stored value it is that value; without any it is the
  /// present one.
  /// @param now  present time, not before the last stored one [s]
  Past before(double now, const Eigen::Ref<const VectorX>& memory) const;
  /// Stores the present value. Values of later times are forgotten: the motion has been set back.
  void store(double now, double value, Eigen::Ref<VectorX> memory) const;
  /// Whether numbers may be such a memory: the number of values is known, and times ascend.
  bool knows(const Eigen::Ref<const VectorX>& memory) const;

 private:
  double span_;
  int points_;
};

}  // namespace bielle::mechanism
