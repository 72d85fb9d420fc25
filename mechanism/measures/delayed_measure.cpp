#include "mechanism/measures/delayed_measure.hpp"

#include <limits>
#include <utility>

#include <fmt/format.h>

#include "mechanism/measures/nested.hpp"
#include "mechanism/model/description.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

constexpr Eigen::Index past_begins = 1;  // place of the history in the memory, which begins with the disturbance

}  // namespace

DelayedMeasure::DelayedMeasure(std::string name, const Measure& of, double time, int points, std::string units)
    : Measure(std::move(name)), of_(of), history_(time, points), units_(std::move(units)) {}

void DelayedMeasure::declare_subjects(Declaration& declaration) const {
  declaration.references = {&of_};
  declaration.memory.assign(past_begins + history_.memory_size(), 0.0);
}

Eigen::Ref<const VectorX> DelayedMeasure::past_of(const LocalState& state) const {
  return state.memory().tail(state.memory().size() - past_begins);
}

ValueHistory::Past DelayedMeasure::past(const LocalState& state) const {
  if (state.environment().statics) return {0, 1};
  ValueHistory::Past before = history_.before(state.time(), past_of(state));
  before.constant += state.memory()[disturbance];
  return before;
}

double DelayedMeasure::value(const LocalState& state) const {
  const ValueHistory::Past before = past(state);
  return before.factor == 0 ? before.constant : before.constant + before.factor * of_.value(state.of(0));
}

double DelayedMeasure::calc(const LocalState& state, MeasureGradient& gradient) const {
  const ValueHistory::Past before = past(state);
  gradient.prepare(state.slots().size());
  if (before.factor == 0) return before.constant;
  Nested<MeasureGradient> present;
  const LocalState of_measure = state.of(0);
  const double value = of_.calc(of_measure, *present);
  const int row = state.slots().reference_row(0), size = of_measure.slots().size();
  gradient.position().segment(row, size) = before.factor * present->position();
  gradient.rate().segment(row, size) = before.factor * present->rate();
  return before.constant + before.factor * value;
}

void DelayedMeasure::check_stored(bool stored, double time) const {
  if (stored) return;
  throw ComputationError(fmt::format(
      "t = {:.6g} s: '{}' cannot store all jumps of {} over {:.6g} s, about {} in number: delay it by a state, "
      "`{{delayed: .., time: .., points: ..}}`, with more `points`",
      time, name(), of_.name(), history_.span(), history_.points() / 3));
}

void DelayedMeasure::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  if (state.environment().statics)
    forget(memory);
  else
    check_stored(history_.store(state.time(), of_.value(state.of(0)), memory.tail(memory.size() - past_begins)),
                 state.time());
}

bool DelayedMeasure::knows_memory(const LocalState& state) const {
  return state.memory()[disturbance] == 0 && history_.knows(past_of(state));
}

/// Adds the kinks of the measure, each after the delay.
void DelayedMeasure::add_break_points(std::vector<double>& times) const {
  std::vector<double> kinks;
  of_.add_break_points(kinks);
  for (const double kink : kinks) times.push_back(kink + history_.span());
}

void DelayedMeasure::describe(const LocalState& /*state*/, Description& description) const {
  description.add(fmt::format("{} [{}], {} as it was {:.6g} s before", name(), units_, of_.name(), history_.span()));
}

void DelayedMeasure::note_jump(const LocalState& state, double time, Eigen::Ref<VectorX> memory) const {
  check_stored(history_.store_after(time, of_.value(state.of(0)), memory.tail(memory.size() - past_begins)), time);
}

double DelayedMeasure::next_echo(const LocalState& state, double after) const {
  return history_.next_jump(after, past_of(state));
}

void DelayedMeasure::forget(Eigen::Ref<VectorX> memory) const { memory.head(past_begins + 2).setZero(); }

}  // namespace bielle::mechanism
