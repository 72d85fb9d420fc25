#include "mechanism/measures/combined_measure.hpp"

#include <fmt/format.h>

#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

CombinedMeasure::CombinedMeasure(std::string name, References references, StateFormula formula, std::string units)
    : Measure(std::move(name)),
      references_(std::move(references)),
      formula_(std::move(formula)),
      units_(std::move(units)) {}

double CombinedMeasure::value(const LocalState& state) const {
  const double t = state.time();
  return formula_.value(state, {&t, 1});
}

double CombinedMeasure::calc(const LocalState& state, MeasureGradient& gradient) const {
  const double t = state.time();
  FormulaGradient of_formula;
  formula_.calc(state, {&t, 1}, of_formula);
  std::swap(gradient, of_formula.by_state);
  if (!formula_.reads_state()) gradient.prepare(state.slots().size());
  return of_formula.value;
}

void CombinedMeasure::describe(const LocalState& /*state*/, Description& description) const {
  description.add(fmt::format("{} [{}]", formula_.text(), units_));
}

}  // namespace bielle::mechanism
