// Prescribed motion of a direction of a node: a displacement over time, or an acceleration that is integrated twice.
//
// From an acceleration a(t), known as a formula or a table, with x_0 and v_0 at t = 0,
//     v(t) = v_0 + integral of a,   x(t) = x_0 + v_0 t + integral of (t - s) a(s) ds.
// Both integrals are Gauss sums over pieces between the formula's break points. Each piece is short enough that halving
// it changes nothing beyond rounding: a table (straight lines between its points) gives piecewise cubic displacements,
// exactly. Pieces are at most the 200th part of the elapsed time, or 1 ms: a shorter feature that is no break point of
// the formula could be missed.
#pragma once

#include <memory>
#include <vector>

#include "reduce/common/formula/expression.hpp"

namespace bielle::mechanism {

class PrescribedMotion {
 public:
  PrescribedMotion() = default;  ///< a motion that stays at zero
  /// @param displacement  displacement as a function of t
  PrescribedMotion(Expression displacement) : function_(std::move(displacement)) {}  // NOLINT: a formula is a motion
  /// @param acceleration  acceleration as a function of t   @param velocity,displacement  at t = 0
  static PrescribedMotion of_acceleration(Expression acceleration, double velocity, double displacement);

  /// @param t  time [s], not before 0 if an acceleration is given
  double operator()(double t) const;
  double derivative(double t, int order) const;  ///< order: 1 or 2
  std::vector<double> break_points() const { return function_.break_points(); }

 private:
  class Integral;
  Expression function_;                 ///< displacement, or acceleration
  std::shared_ptr<Integral> integral_;  ///< integral of an acceleration
};

}  // namespace bielle::mechanism
