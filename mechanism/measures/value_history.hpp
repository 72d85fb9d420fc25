// The past of a value in a component's memory: the values at the ends of accepted steps over a time T, its jumps, and
// interpolation between them.
//
// Between two stored times the value is the cubic of Hermite with slopes of parabolas through three neighbours (error
// of third order in their distance). From the last stored time to the present it is the parabola through the last two
// values and the present one, which is still unknown to the solver: the weight of the present value is returned. Values
// are kept at distances of T/points at least, so that the memory has a fixed size for steps of any size.
//
// At a discontinuity of the motion the values just before and just after it are stored with the same time: no parabola
// passes over it, and if the two differ, the value that is delayed by T jumps at this time plus T.
//
//     memory: [number of values | number of discontinuities | t_0, y_0, t_1, y_1, .. ascending]
#pragma once

#include <limits>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

class ValueHistory {
 public:
  /// @param span    T [s] > 0
  /// @param points  number of values over this time, at least 4; as many more are left to jumps, see `store`
  ValueHistory(double span, int points) : span_(span), points_(points) {}
  double span() const { return span_; }
  int points() const { return points_; }
  std::size_t memory_size() const { return 2 + 2 * static_cast<std::size_t>(capacity()); }

  /// A past value as constant + factor * present value.
  struct Past {
    double constant = 0, factor = 0;
  };
  /// Returns the value T before the present. Before the first stored value it is that value; without any it is the
  /// present one. At the time of a jump it is the value before it.
  /// @param now  present time, not before the last stored one [s]
  Past before(double now, const Eigen::Ref<const VectorX>& memory) const;
  /// Stores the present value. Values of later times are forgotten: the motion has been set back.
  /// @returns false if the memory is full of jumps: there are about points/3 of them, or more, within T. It is then
  ///          unchanged
  [[nodiscard]] bool store(double now, double value, Eigen::Ref<VectorX> memory) const;
  /// Stores the value just after a discontinuity. The last stored value is the one just before it; it is stored first
  /// if none is. The latest call for a time holds. Values that differ by no more than rounding are no jump.
  /// @param time  time of the discontinuity, that of the last stored value up to rounding [s] @returns as `store`
  [[nodiscard]] bool store_after(double time, double value, Eigen::Ref<VectorX> memory) const;
  /// Returns the first time after `after` at which the value that is delayed by T jumps; infinity if it does not.
  double next_jump(double after, const Eigen::Ref<const VectorX>& memory) const;
  /// Whether numbers may be such a memory: the numbers of values and discontinuities are known, and times ascend.
  bool knows(const Eigen::Ref<const VectorX>& memory) const;

 private:
  int capacity() const { return 2 * points_ + 8; }
  double span_;
  int points_;
};

}  // namespace bielle::mechanism
