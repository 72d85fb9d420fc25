// Evaluation of formulas of time between the ends of a step.
//
// The scheme evaluates f(t) at the ends of its steps. In a step of size h, a formula in a residual, or of a rate, has
// the effect
//     T = h (f_n + f_{n+1})/2     in place of     Q = int f dt,
// Here Q is computed by the midpoint rule over parts of the step. A prescribed position has the effect of the cubic H
// through its values and rates at the ends. For functions that steps resolve, |T - Q| is (omega h)^2/12 of int |f| dt
// and |f - H| is (omega h)^4/384 of |f|; for a pulse within the step it is the whole value.
//
// The dependence of a formula on the state (a spring with a force of time) is not included: changes are relative to the
// value at another time, with the state at the end of the step.
#pragma once

#include <span>
#include <vector>

#include "mechanism/model/time_dependent.hpp"

namespace bielle::mechanism {

struct FormulaLook {
  double missed = 0;         ///< |T - Q| [units s], or the largest |f - H| [units]
  double whole = 0;          ///< integral of the absolute change [units s]
  double off = 0;            ///< largest distance from the chord between the ends, or from H [units]
  double low = 0, high = 0;  ///< range of the change [units]
  double largest = 0;        ///< |f| [units]
};

/// A step, and the parameters of its evaluation.
struct LookedStep {
  double begin = 0, end = 0;  ///< [s]
  int parts = 0;
  double reference = 0;  ///< time relative to which formulas change [s]
  double size() const { return end - begin; }
  double inside() const { return 1e-9 * size(); }  ///< distance from the ends: jumps there belong to other steps [s]
  double middle(int part) const { return begin + (part + 0.5) / parts * size(); }
};

class FormulaLooker {
 public:
  /// Evaluates the formulas of one component.
  /// @param state  only its time is changed
  /// @param looks  one for each formula
  /// @throws ComputationError if one has no value
  void look(const TimeDependent& component, const std::vector<TimeDependent::Formula>& formulas, State& state,
            const Slots& slots, const Environment& environment, const LookedStep& step, std::span<FormulaLook> looks);

 private:
  std::vector<double> begin_, end_, begin_rate_, end_rate_, reference_, value_, sum_;  ///< buffers
};

}  // namespace bielle::mechanism
