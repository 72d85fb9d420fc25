#include "mechanism/elements/control/state_output.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

StateOutput::StateOutput(std::string name, const StateUnknowns& unknowns, References references, VectorX c,
                         std::vector<Through> through, std::string units)
    : Measure(std::move(name)),
      references_(std::move(references)),
      c_(std::move(c)),
      through_(std::move(through)),
      units_(std::move(units)) {
  if (references_.add(unknowns) != 0) throw std::logic_error("an output refers to its unknowns first");
}

double StateOutput::value(const LocalState& state) const {
  const double t = state.time();
  double sum = c_.dot(state.of(0).first_order());
  for (const Through& each : through_) sum += each.factor * each.input.value(state, {&t, 1});
  return sum;
}

double StateOutput::calc(const LocalState& state, MeasureGradient& gradient) const {
  const double t = state.time();
  gradient.prepare(state.slots().size());
  gradient.position().segment(state.slots().reference_row(0), c_.size()) = c_;
  double sum = c_.dot(state.of(0).first_order());
  FormulaGradient of_input;  // a measure may depend on other measures: the buffer must not be shared
  for (const Through& each : through_) {
    each.input.calc(state, {&t, 1}, of_input);
    sum += each.factor * of_input.value;
    if (!each.input.reads_state()) continue;
    gradient.position() += each.factor * of_input.by_state.position();
    gradient.rate() += each.factor * of_input.by_state.rate();
  }
  return sum;
}

bool StateOutput::reads_reactions() const {
  return std::any_of(through_.begin(), through_.end(),
                     [](const Through& each) { return each.input.reads_reactions(); });
}

bool StateOutput::holds_time() const {
  return std::any_of(through_.begin(), through_.end(), [](const Through& each) { return each.input.holds_time(); });
}

void StateOutput::add_break_points(std::vector<double>& times) const {
  for (const Through& each : through_) each.input.add_break_points(0, times);
}

void StateOutput::describe(const LocalState& /*state*/, Description& description) const {
  description.add(fmt::format("{} [{}]", name(), units_));
}

}  // namespace bielle::mechanism
