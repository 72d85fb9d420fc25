// A look at formulas of time between the ends of a step.
//
// The scheme sees f(t) at the ends of its steps. Over a step of size h, a formula in a residual, or of a rate, counts
// as
//     T = h (f_n + f_{n+1})/2     in place of     Q = int f dt,
// Q by the midpoints of parts of the step. A prescribed position counts as the cubic H through its values and rates at
// the ends. Of what steps resolve, |T - Q| is (omega h)^2/12 of int |f| dt and |f - H| is (omega h)^4/384 of |f|; of a
// pulse within the step it is all of it.
//
// The part that the state has in a formula (a spring with a force of time) does not count: changes are relative to its
// value at another time, with the state as it is at the end of the step.
#pragma once

#include <span>
#include <vector>

#include "mechanism/model/time_dependent.hpp"

namespace bielle::mechanism {

struct FormulaLook {
  double missed = 0;         ///< |T - Q| [units s], or the largest |f - H| [units]
  double whole = 0;          ///< int of the change's size [units s]
  double off = 0;            ///< farthest from the chord between the ends, or from H [units]
  double low = 0, high = 0;  ///< of the change [units]
  double largest = 0;        ///< |f| [units]
};

/// A step, and how it is looked at.
struct LookedStep {
  double begin = 0, end = 0;  ///< [s]
  int parts = 0;
  double reference = 0;  ///< time relative to which formulas change [s]
  double size() const { return end - begin; }
  double inside() const { return 1e-9 * size(); }  ///< off the ends: jumps there are of other steps [s]
  double middle(int part) const { return begin + (part + 0.5) / parts * size(); }
};

class FormulaLooker {
 public:
  /// Looks at the formulas of one component.
  /// @param state  its time is moved about, and nothing else
  /// @param looks  as many as there are formulas
  /// @throws ComputationError  where one has no value
  void look(const TimeDependent& component, const std::vector<TimeDependent::Formula>& formulas, State& state,
            const Slots& slots, const Environment& environment, const LookedStep& step, std::span<FormulaLook> looks);

 private:
  std::vector<double> begin_, end_, begin_rate_, end_rate_, reference_, value_, sum_;  ///< buffers
};

}  // namespace bielle::mechanism
