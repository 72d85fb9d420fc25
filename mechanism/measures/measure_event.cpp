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

const KeyTable& event_keys() {
  using namespace keys;
  static const KeyTable table{
      "an event",
      "A measure that crosses a value.",
      {{"when", state_formula("any", {"t"}), required, "Measure that is watched, or a formula of measures."},
       {"crosses", number("any"), otherwise("0"), "Value that is crossed."},
       crossing_direction_key(),
       {"action", word({"note", "restart", "stop"}, "an action"), otherwise("note"),
        "Action at the crossing: `note` lists its time and does not change the motion; `restart` ends a step there and "
        "solves for accelerations and reactions again, as at a kink of a load; `stop` ends the analysis, and those "
        "that follow go on from there."}}};
  return table;
}

void read_event(const std::string& name, const YamlValue& given, Model& model) {
  const YamlValue entry = given.keyed(event_keys());
  const YamlValue when = entry.at("when");
  const double value = entry.at("crosses").number();
  const EventFunction::Direction direction = read_crossing_direction(entry);
  const std::string word = entry.at("action").word();
  const MeasureEvent::Action action = word == "stop"      ? MeasureEvent::Action::stop
                                      : word == "restart" ? MeasureEvent::Action::restart
                                                          : MeasureEvent::Action::note;
  model.when_read(Model::Stage::formulas, [=, &model] {
    model.add(std::make_unique<MeasureEvent>(name, measure_named_by(when, model), value, direction, action),
              Entry{Section::events, name}, Recorded::no);
  });
}

}  // namespace bielle::mechanism
