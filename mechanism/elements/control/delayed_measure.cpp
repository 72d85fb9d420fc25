#include "mechanism/elements/control/delayed_measure.hpp"

#include <memory>
#include <utility>

#include <fmt/format.h>

#include "mechanism/measures/read_measure.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

DelayedMeasure::DelayedMeasure(std::string name, const Measure& of, double time, int points, std::string units)
    : Measure(std::move(name)), of_(of), time_(time), history_(time, points), units_(std::move(units)) {}

void DelayedMeasure::declare_subjects(Declaration& declaration) const {
  declaration.references = {&of_};
  declaration.memory.assign(history_.memory_size(), 0.0);
}

ValueHistory::Past DelayedMeasure::past(const LocalState& state) const {
  if (state.environment().statics) return {0, 1};
  return history_.before(state.time(), state.memory());
}

double DelayedMeasure::value(const LocalState& state) const {
  const ValueHistory::Past before = past(state);
  return before.factor == 0 ? before.constant : before.constant + before.factor * of_.value(state.of(0));
}

double DelayedMeasure::calc(const LocalState& state, MeasureGradient& gradient) const {
  const ValueHistory::Past before = past(state);
  gradient.prepare(state.slots().size());
  if (before.factor == 0) return before.constant;
  MeasureGradient present;  // a measure may depend on other measures: the buffer must not be shared
  const LocalState of_measure = state.of(0);
  const double value = of_.calc(of_measure, present);
  const int row = state.slots().reference_row(0), size = of_measure.slots().size();
  gradient.position().segment(row, size) = before.factor * present.position();
  gradient.rate().segment(row, size) = before.factor * present.rate();
  return before.constant + before.factor * value;
}

void DelayedMeasure::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  if (state.environment().statics)
    memory[0] = 0;
  else
    history_.store(state.time(), of_.value(state.of(0)), memory);
}

/// Kinks of the measure in time come back after the delay.
void DelayedMeasure::add_break_points(std::vector<double>& times) const {
  std::vector<double> kinks;
  of_.add_break_points(kinks);
  for (const double kink : kinks) times.push_back(kink + time_);
}

void DelayedMeasure::describe(const LocalState& /*state*/, Description& description) const {
  description.add(fmt::format("{} [{}], {} as it was {:.6g} s before", name(), units_, of_.name(), time_));
}

Key delay_key() {
  using namespace keys;
  return {"delayed", state_formula("any", {"t"}), required, "Measure that is delayed, or a formula of measures."};
}

const KeyTable& delay_keys() {
  using namespace keys;
  static const KeyTable table{
      "a delay",
      "A measure as it was a time before; at first, as it was at the beginning of the motion.",
      {delay_key(),
       {"time", number("s").positive(), required, "Time by which the measure is delayed."},
       {"points", integer().between(4, 1e6), otherwise("400"),
        "Largest number of values that are stored over this time, at the ends of steps."},
       {"units", text(), computed("those of the measure"), "Units that are recorded with the values."}}};
  return table;
}

void read_delay(const std::string& name, const YamlValue& entry, Model& model) {
  const double time = entry.at("time").number();
  const int points = entry.at("points").integer();
  model.announce_measure(name, [name, entry, time, points, &model] {
    const Measure& of = measure_named_by(entry.at("delayed"), model);
    const auto units = entry.find("units");
    model.add_measure_of(Entry{Section::states, name},
                         std::make_unique<DelayedMeasure>(name, of, time, points, units ? units->text() : of.units()),
                         true);
  });
}

}  // namespace bielle::mechanism
