// Where Newton's method starts in a step: accelerations, rates of first-order unknowns and multipliers extrapolated
// over the last accepted steps.
//
// Of order p: the polynomial through the last p + 1 accepted values, at their times (steps may change in size). Smooth
// motion makes the start better by a power of the step for each order. What alternates from step to step, an error e of
// multipliers or the ringing of a stiff body, it makes worse: 2 e, 4 e, 8 e, ... Hence the order is chosen by
// measurement: from time to time, and where the residual that a step starts with has grown, starts of the orders next
// to the present one are evaluated too, and the smallest residual wins. After a discontinuity everything is forgotten.
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
  /// Takes the values of an accepted state. Where that is hardly later than the last one (a step that an event has cut
  /// short), it takes its place: polynomials through both would be of no use.
  void add(double time, const VectorX& values);
  /// The values of an order at a time.
  /// @param order  at most `highest_order()`
  void calc(int order, double time, VectorX& values) const;
  /// The highest order that the accepted states allow; -1: there is none.
  int highest_order() const { return std::min(count_ - 1, allowed_); }
  /// The highest order that amplifies errors of the values no more than steps of equal size do. @param time  of the
  /// start
  int highest_order(double time) const;

  /// The order to start from at a time, where nothing else is known.
  int order(double time) const { return std::min(order_, highest_order(time)); }
  /// Whether the order should be chosen anew. @param size  of the residual that the step starts with
  bool wants_choice(double size) const;
  /// @param size  of the residual that the step starts with in this order
  void choose(int order, double size);
  /// The step has gone on from this order as it was. @param size  as above
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
  int order_ = 0, chosen_among_ = 0;  ///< the orders that there were to choose from
  int age_ = 0;                       ///< steps since the order was chosen
  int lasts_ = 16;                    ///< steps that the choice holds
  double size_ = 0;                   ///< of the residual when it was
};

}  // namespace bielle::mechanism
