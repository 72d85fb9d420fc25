// Interface of components with an unknown whose equation is a balance of flows: data that solvers need to find its
// value.
#pragma once

namespace bielle::mechanism {

/// An algebraic first-order unknown y whose equation f(y, ..) = 0 is a balance: f never decreases as y grows (the net
/// flow out of a junction, as a function of its pressure), and is constant in ranges without flow. Newton's method does
/// not leave such a range; solvers then search for y between two bounds.
class FlowBalance {
 public:
  struct Range {
    int unknown = 0;               ///< index among the component's own first-order unknowns, and of its equation
    double least = 0, most = 0;    ///< bounds, in the unknown's units
    const char* when_below = "";   ///< clause on the error if the balance requires less than the least value
    const char* when_beyond = "";  ///< clause on the error if the balance requires more than the largest value
  };
  virtual ~FlowBalance() = default;
  virtual Range balance_range() const = 0;
};

}  // namespace bielle::mechanism
