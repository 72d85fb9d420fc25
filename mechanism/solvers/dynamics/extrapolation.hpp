// Initial guess of Newton's method in a step: accelerations, rates of first-order unknowns and multipliers are
// extrapolated over the last accepted steps.
//
// Order p means the polynomial through the last p + 1 accepted values, at their times (the step size may change). For a
// smooth motion, each order improves the initial guess by a power of the step. It amplifies values that alternate from
// step to step, such as an error e of multipliers or the oscillation of a stiff body: 2 e, 4 e, 8 e, ... Therefore the
// order is chosen by measurement: periodically, and if the initial residual of a step has grown, initial guesses of the
// neighbouring orders are evaluated too, and the one with the smallest residual is used. After a discontinuity all
// earlier values are discarded.
#pragma once

#include <algorithm>
#include <array>

#include "mechanism/model/archive.hpp"

namespace bielle::mechanism {

class Extrapolation {
 public:
  static constexpr int most_order = 4;
  /// @param size     number of values
  /// @param allowed  highest order that is tried
  Extrapolation(int size, int allowed);

  void forget();
  /// Takes the values of an accepted state. If this state is hardly later than the last one (a step that was shortened
  /// by an event), it replaces the last one: polynomials through both would be useless.
  void add(double time, const VectorX& values);
  /// Computes the values of a given order at a time.
  /// @param order  at most `highest_order()`
  void calc(int order, double time, VectorX& values) const;
  /// Returns the highest order that the number of accepted states permits; -1: there is none.
  int highest_order() const { return std::min(count_ - 1, allowed_); }
  /// Returns the highest order that amplifies errors of the values no more than with steps of equal size. @param time
  /// time of the initial guess
  int highest_order(double time) const;

  /// Returns the order to use at a time without further information.
  int order(double time) const { return std::min(order_, highest_order(time)); }
  /// Returns whether the order should be chosen again. @param size  size of the residual at the initial guess of the
  /// step
  bool wants_choice(double size) const;
  /// @param size  size of the residual at the initial guess of this order
  void choose(int order, double size);
  /// Notes a step whose order was not chosen again. @param size  size of the residual at the initial guess
  void note(double size);
  void exchange(Archive& archive);

 private:
  using Weights = std::array<double, most_order + 1>;
  Weights weights(int order, double time) const;
  const VectorX& value(int steps_ago) const { return values_[place(steps_ago)]; }
  std::size_t place(int steps_ago) const {
    return static_cast<std::size_t>((newest_ + most_order + 1 - steps_ago) % (most_order + 1));
  }

  std::array<VectorX, most_order + 1> values_;
  std::array<double, most_order + 1> times_{};  ///< [s]
  int allowed_;
  int newest_ = 0, count_ = 0;
  int order_ = 0, chosen_among_ = 0;  ///< order_: in use; chosen_among_: highest order at the choice
  int age_ = 0;                       ///< number of steps since the order was chosen
  int lasts_ = 16;                    ///< number of steps for which the choice is valid
  double size_ = 0;                   ///< smallest initial residual since the choice
};

}  // namespace bielle::mechanism
