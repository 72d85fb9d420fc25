#include "mechanism/measures/state_formula.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mechanism/measures/nested.hpp"
#include "mechanism/model/time_dependent.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
StateFormula::StateFormula(Expression expression, std::size_t own, std::vector<Argument> measures)
    : expression_(std::move(expression)), own_(own), measures_(std::move(measures)) {
  if (own_ > FormulaGradient::most_variables || own_ + measures_.size() > most_arguments)
    throw InputError(fmt::format("a formula of more than {} quantities: name some of them together in `measures`",
                                 most_arguments - own_));
}

bool StateFormula::reads_reactions() const {
  return std::any_of(measures_.begin(), measures_.end(),
                     [](const Argument& argument) { return argument.measure->reads_reactions(); });
}

bool StateFormula::holds_time(std::size_t time) const {
  return uses(time) || std::any_of(measures_.begin(), measures_.end(), [](const Argument& argument) {
           const auto* timed = dynamic_cast<const TimedMeasure*>(argument.measure);
           return timed && timed->holds_time();
         });
}

double StateFormula::value(const LocalState& state, std::span<const double> variables) const {
  if (measures_.empty()) return expression_(variables.first(own_));
  std::array<double, most_arguments> values;
  std::copy_n(variables.begin(), own_, values.begin());
  for (std::size_t k = 0; k < measures_.size(); ++k)
    values[own_ + k] = measures_[k].measure->value(state.of(measures_[k].reference));
  return expression_({values.data(), own_ + measures_.size()});
}

void StateFormula::calc(const LocalState& state, std::span<const double> variables, FormulaGradient& gradient) const {
  if (measures_.empty()) {
    gradient.value = expression_.value_and_gradient(variables.first(own_), {gradient.by_variable.data(), own_});
    gradient.by_state.prepare(0);
    return;
  }
  std::array<double, most_arguments> values, derivatives;
  std::copy_n(variables.begin(), own_, values.begin());
  for (std::size_t k = 0; k < measures_.size(); ++k)
    values[own_ + k] = measures_[k].measure->value(state.of(measures_[k].reference));
  const std::size_t count = own_ + measures_.size();
  gradient.value = expression_.value_and_gradient({values.data(), count}, {derivatives.data(), count});
  std::copy_n(derivatives.begin(), own_, gradient.by_variable.begin());
  gradient.by_state.prepare(state.slots().size());
  Nested<MeasureGradient> nested;
  MeasureGradient& of_measure = *nested;
  for (std::size_t k = 0; k < measures_.size(); ++k) {
    const double factor = derivatives[own_ + k];
    if (factor == 0) continue;
    const LocalState local = state.of(measures_[k].reference);
    measures_[k].measure->calc(local, of_measure);
    const int row = state.slots().reference_row(measures_[k].reference), size = local.slots().size();
    gradient.by_state.position().segment(row, size) += factor * of_measure.position();
    gradient.by_state.rate().segment(row, size) += factor * of_measure.rate();
  }
}

void StateFormula::add_break_points(std::size_t variable, std::vector<double>& points) const {
  if (variable >= own_) return;
  const std::vector<double> own = expression_.break_points(variable);
  points.insert(points.end(), own.begin(), own.end());
}

}  // namespace bielle::mechanism
