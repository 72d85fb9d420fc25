#include "mechanism/measures/state_formula.hpp"

#include <algorithm>
#include <deque>

#include <fmt/format.h>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

/// Gradients of measures under way: a measure may be a formula of measures itself, and each level needs its own.
struct Gradients {
  std::deque<MeasureGradient> of_level;
  std::size_t level = 0;
};
thread_local Gradients gradients;

/// The gradient of a level, while it lives.
class GradientLevel {
 public:
  GradientLevel() {
    if (gradients.of_level.size() == gradients.level) gradients.of_level.emplace_back();
    mine_ = &gradients.of_level[gradients.level++];
  }
  ~GradientLevel() { --gradients.level; }
  GradientLevel(const GradientLevel&) = delete;
  GradientLevel& operator=(const GradientLevel&) = delete;
  MeasureGradient& gradient() { return *mine_; }

 private:
  MeasureGradient* mine_;
};

}  // namespace

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
  GradientLevel level;
  MeasureGradient& of_measure = level.gradient();
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
