// Returns the only formula of time of a component, as TimeDependent requires.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/time_dependent.hpp"

namespace bielle::mechanism {

/// The list is empty if the formula does not contain t. @param formula  formula of t and measures
inline std::vector<TimeDependent::Formula> time_formulas_of(const StateFormula& formula, std::string name,
                                                            std::string units) {
  if (!formula.holds_time()) return {};
  return {{std::move(name), std::move(units)}};
}

inline void calc_time_formula(const StateFormula& formula, const LocalState& state, std::span<double> values) {
  const double t = state.time();
  values[0] = formula.value(state, {&t, 1});
}

}  // namespace bielle::mechanism
