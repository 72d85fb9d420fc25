#include "mechanism/measures/measure_event.hpp"

#include <fmt/format.h>

#include "mechanism/measures/read_measure.hpp"
#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

MeasureEvent::MeasureEvent(std::string name, const Measure& measure, double value, EventFunction::Direction direction,
                           Action action)
    : Component("event", std::move(name)), measure_(measure), value_(value), direction_(direction), action_(action) {
  references_.add(measure);
}

void MeasureEvent::declare(Declaration& declaration) const {
  declaration.passive = true;
  references_.declare(declaration);
  EventFunction crossing;
  crossing.direction = direction_;
  crossing.restarts = action_ == Action::restart;
  crossing.stops = action_ == Action::stop;
  crossing.reads_reaction = measure_.reads_reactions();
  declaration.event_functions = {crossing};
}

void MeasureEvent::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  values[0] = measure_.value(state.of(0)) - value_;
}

void MeasureEvent::describe(const LocalState& /*state*/, Description& description) const {
  const char* way = direction_ == EventFunction::Direction::rising    ? "rises through"
                    : direction_ == EventFunction::Direction::falling ? "falls through"
                                                                      : "crosses";
  description.add(fmt::format("{} {} {:.6g} {}", measure_.name(), way, value_, measure_.units()));
  description.add(action_ == Action::stop      ? "stops the run"
                  : action_ == Action::restart ? "ends a step and restarts the motion"
                                               : "is noted");
}

EventFunction::Direction read_crossing_direction(const YamlValue& entry) {
  const auto word = entry.find("direction");
  if (!word) return EventFunction::Direction::both;
  const std::string chosen = word->word({"rising", "falling", "both"}, "a direction of crossing");
  return chosen == "rising"    ? EventFunction::Direction::rising
         : chosen == "falling" ? EventFunction::Direction::falling
                               : EventFunction::Direction::both;
}

void read_event(const std::string& name, const YamlValue& entry, Model& model) {
  entry.check_keys({"when", "crosses", "direction", "action"}, "an event");
  const YamlValue when = entry.at("when");
  const double value = entry.has("crosses") ? entry.at("crosses").number() : 0;
  const EventFunction::Direction direction = read_crossing_direction(entry);
  const std::string word =
      entry.has("action") ? entry.at("action").word({"note", "restart", "stop"}, "an action") : "note";
  const MeasureEvent::Action action = word == "stop"      ? MeasureEvent::Action::stop
                                      : word == "restart" ? MeasureEvent::Action::restart
                                                          : MeasureEvent::Action::note;
  model.when_read(Model::Stage::formulas, [=, &model] {
    model.add(std::make_unique<MeasureEvent>(name, measure_named_by(when, model), value, direction, action),
              Entry{Section::events, name}, Recorded::no);
  });
}

}  // namespace bielle::mechanism
