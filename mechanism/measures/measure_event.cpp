#include "mechanism/measures/measure_event.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "mechanism/model/description.hpp"
#include "mechanism/reading/names.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

MeasureEvent::MeasureEvent(const EventRecord& record, const Measure& measure, double value,
                           EventFunction::Direction direction, Action action)
    : Component("event", record.name()),
      record_(record),
      measure_(measure),
      value_(value),
      direction_(direction),
      action_(action) {
  references_.add(measure);
  of_record_ = references_.add(record);
}

void MeasureEvent::occur_after(const EventRecord& other) {
  after_ = &other;
  of_after_ = references_.add(other);
}

void MeasureEvent::declare(Declaration& declaration) const {
  declaration.passive = true;
  references_.declare(declaration);
  EventFunction crossing;
  crossing.name = effects();
  crossing.direction = direction_;
  crossing.restarts = action_ == Action::restart || record_.is_used();
  crossing.stops = action_ == Action::stop;
  if (at_start_) crossing.begins_on = side_before();
  crossing.reads_reaction =
      measure_.reads_reactions() ||
      std::any_of(writes_.begin(), writes_.end(), [](const Write& write) { return write.value.reads_reactions(); });
  declaration.event_functions = {crossing};
}

bool MeasureEvent::is_armed(const LocalState& state) const {
  if (once_ && EventRecord::has_happened(state.of(of_record_))) return false;
  return !after_ || EventRecord::has_happened(state.of(of_after_));
}

/// Computes the value. It is zero for an event that cannot occur, because zero has no side that could be left.
void MeasureEvent::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  values[0] = is_armed(state) ? measure_.value(state.of(0)) - value_ : 0;
  // A value that is reached exactly at the start counts as beyond.
  if (at_start_ && values[0] == 0 && is_armed(state)) values[0] = -side_before() * std::numeric_limits<double>::min();
}

void MeasureEvent::act(const LocalState& state, std::span<const int> /*crossed*/,
                       const ReferencedMemory& memory) const {
  if (!record_.is_used()) return;
  EventRecord::happen(state.time(), memory.of(of_record_));
  const double t = state.time();
  for (const Write& write : writes_) {
    const double value =
        write.locks ? write.locks->present_value(state.of(write.reference)) : write.value.value(state, {&t, 1});
    if (!std::isfinite(value))
      throw ComputationError(
          fmt::format("t = {:.6g} s: event '{}' {}, which has no finite value", t, name(), write.description));
    memory.of(write.reference)[write.place] = value;
  }
}

bool MeasureEvent::switches_parts() const {
  return std::any_of(writes_.begin(), writes_.end(), [](const Write& write) { return write.switches; });
}

std::string MeasureEvent::effects() const {
  std::string text;
  for (const Write& write : writes_)
    if (!write.description.empty()) text += (text.empty() ? "" : ", ") + write.description;
  if (!writes_.empty() && action_ == Action::stop) text += ", stops the run";
  return text;
}

void MeasureEvent::describe(const LocalState& /*state*/, Description& description) const {
  const char* way = direction_ == EventFunction::Direction::rising    ? "rises through"
                    : direction_ == EventFunction::Direction::falling ? "falls through"
                                                                      : "crosses";
  std::string when = fmt::format("{} {} {:.6g} {}", measure_.name(), way, value_, measure_.units());
  if (after_) when += fmt::format(", after '{}'", after_->name());
  if (once_) when += ", once";
  if (at_start_) when += ", also at the start";
  description.add(when);
  description.add(!writes_.empty()             ? effects()
                  : action_ == Action::stop    ? "stops the run"
                  : action_ == Action::restart ? "ends a step and restarts the motion"
                  : record_.is_used()          ? "is counted, and restarts the motion"
                                               : "is noted");
}

const MeasureEvent& measure_event_named_by(const YamlValue& value, const Model& model) {
  component_named_by(Section::events, value, model);  // refuses names of other things
  for (const Component* component : model.components_of({Section::events, value.text()}))
    if (const auto* event = dynamic_cast<const MeasureEvent*>(component)) return *event;
  throw std::logic_error("an event is asked for before events have been read");
}

namespace {
const std::vector<std::string> crossing_directions = {"rising", "falling", "both"};
}  // namespace

Key crossing_direction_key() {
  using namespace keys;
  return {"direction", word(crossing_directions, "a direction of crossing"), otherwise("both"),
          "Direction in which the value is crossed."};
}

EventFunction::Direction read_crossing_direction(const YamlValue& entry) {
  const auto given = entry.find("direction");
  if (!given) return EventFunction::Direction::both;
  const std::string chosen = given->word(crossing_directions, "a direction of crossing");
  return chosen == "rising"    ? EventFunction::Direction::rising
         : chosen == "falling" ? EventFunction::Direction::falling
                               : EventFunction::Direction::both;
}

}  // namespace bielle::mechanism
