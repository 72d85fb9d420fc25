// Components with an unknown whose equation is a balance of flows: what solvers need to know to search for it.
#pragma once

namespace bielle::mechanism {

/// An algebraic first-order unknown y whose equation f(y, ..) = 0 is a balance: f never falls as y grows (the net flow
/// out of a junction, by its pressure), and is flat wherever nothing flows. Newton's method finds no way out of such a
/// range; solvers then search for y between two bounds.
class FlowBalance {
 public:
  struct Range {
    int unknown = 0;               ///< among the component's own first-order unknowns; its equation likewise
    double least = 0, most = 0;    ///< bounds, in the unknown's units
    const char* when_below = "";   ///< a clause: what is wrong where the balance asks for less than the least value
    const char* when_beyond = "";  ///< likewise for more than the largest
  };
  virtual ~FlowBalance() = default;
  virtual Range balance_range() const = 0;
};

}  // namespace bielle::mechanism
