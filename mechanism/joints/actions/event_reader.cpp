#include "mechanism/joints/actions/event_reader.hpp"

#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "mechanism/joints/actions/event_targets.hpp"
#include "mechanism/measures/measure_event.hpp"
#include "mechanism/measures/read_measure.hpp"
#include "mechanism/reading/read_activity.hpp"

namespace bielle::mechanism {
namespace {

/// A write whose component is known. Its formula is read later.
struct PlannedWrite {
  const Component* component;
  int place;
  double constant;
  std::optional<YamlValue> formula;  ///< takes the place of the constant
  bool switches;
  std::string description;          ///< empty: it is part of another write's description
  const Lockable* locks = nullptr;  ///< locks at the present value, which takes the place of the constant
};

struct PlannedEvent {
  std::vector<PlannedWrite> writes;
  bool stops = false;
};

void plan_lock(const YamlValue& value, bool closes, Model& model, PlannedEvent& event) {
  const std::string description = fmt::format("{} '{}'", closes ? "locks" : "unlocks", value.text());
  if (const auto [valve, lock] = valve_named_by(value, model); lock) {
    if (closes) event.writes.push_back({valve, lock->locked_value_place(), 0, {}, true, "", lock});
    event.writes.push_back({valve, lock->lock_command_place(), closes ? 1.0 : -1.0, {}, true, description});
    return;
  }
  bool first = true;
  for (const JointLock* lock : locks_named_by(value, model)) {
    event.writes.push_back({lock, JointLock::command_place, closes ? 1.0 : -1.0, {}, true, first ? description : ""});
    first = false;
  }
}

void plan_activity(const YamlValue& value, bool acts, Model& model, PlannedEvent& event) {
  const Activity& activity = activity_named_by(value, model);
  event.writes.push_back({&activity,
                          0,
                          acts ? 1.0 : 0.0,
                          {},
                          true,
                          fmt::format("{} '{}'", acts ? "activates" : "releases", value.text())});
}

void plan_set(const YamlValue& value, Model& model, PlannedEvent& event) {
  const auto inputs = value.entries();
  if (inputs.empty()) value.fail("expected the name of an input with its new value");
  for (const auto& [name, formula] : inputs)
    event.writes.push_back({&input_named_by(name, formula, model), 0, 0, formula, false,
                            fmt::format("sets '{}' to {}", name, formula.text())});
}

void plan_action(const YamlValue& given, Model& model, PlannedEvent& event) {
  if (!given.is_map()) given.fail("expected an action: {lock: joint}, {release: name}, {set: {input: value}}, ..");
  const YamlValue entry = given.keyed(event_action_keys());
  const auto keys = entry.entries();
  if (keys.size() != 1) given.fail("expected one action in each item of `do`: they are done in the order of the list");
  const auto& [key, value] = keys.front();
  if (key == "lock" || key == "unlock")
    plan_lock(value, key == "lock", model, event);
  else if (key == "release" || key == "activate")
    plan_activity(value, key == "activate", model, event);
  else if (key == "set")
    plan_set(value, model, event);
  else if (value.boolean())
    event.stops = true;
  else
    value.fail("expected `true`; leave the action out if the run goes on");
}

/// Adds the planned writes to an event, and reads their formulas.
void add_writes(const std::vector<PlannedWrite>& planned, MeasureEvent& event, Model& model) {
  for (const PlannedWrite& each : planned) {
    MeasureEvent::Write write;
    write.reference = event.references().add(*each.component);
    write.place = each.place;
    write.switches = each.switches;
    write.locks = each.locks;
    write.description = each.description;
    write.value = each.formula ? read_state_formula(*each.formula, {"t"}, model, event.references())
                               : StateFormula(each.constant);
    event.add(std::move(write));
  }
}

MeasureEvent::Action read_action(const YamlValue& entry) {
  const std::string word = entry.at("action").word();
  return word == "stop"      ? MeasureEvent::Action::stop
         : word == "restart" ? MeasureEvent::Action::restart
                             : MeasureEvent::Action::note;
}

}  // namespace

const KeyTable& lock_event_keys() {
  using namespace keys;
  static const KeyTable table{"an event of a lock",
                              "An event in place of a time.",
                              {{"event", name_of("event"), required, "Name of the event."}}};
  return table;
}

const KeyTable& event_action_keys() {
  using namespace keys;
  static const KeyTable table{
      "an action of an event",
      "A change of the mechanism at an event; each item of `do` has one key.",
      {{"lock", name_of("joint or valve"), optional,
        "Joint whose coordinates are locked at their present values, or one coordinate of it (`knee.angle`). An "
        "inelastic impulse stops their rates; the energy that it takes is dissipated. Or a valve, which keeps its "
        "present opening whatever its command."},
       {"unlock", name_of("joint or valve"), optional,
        "Joint, or coordinate of a joint, whose lock is opened; or a valve, which follows its command again."},
       {"release", name_of("entry"), optional,
        "Joint, element, drive or load that acts no more: its constraints vanish, its forces are zero. A joint takes "
        "along its springs, friction, locks and drives. The energy that it stored is dissipated. An orifice or valve "
        "that is released is closed."},
       {"activate", name_of("entry"), optional,
        "Joint, element, drive, load, orifice or valve that acts again, or from now on. Its constraints have to fit "
        "the "
        "position; rates that contradict them are stopped by an inelastic impulse. Energy that appears in a spring is "
        "supplied."},
       {"set", entries("input", {state_formula("any", {"t"})}), optional,
        "Inputs with their new values: numbers, or formulas of t and measures at the event."},
       {"stop", boolean(), optional, "`true`: the analysis ends, after the other actions."}}};
  return table;
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
        "that follow go on from there."},
       {"do", list_of(nested(event_action_keys)).items_at_least(1), optional,
        "Actions at the crossing, in place of `action`: done in the order of the list, all at the same instant."},
       {"once", boolean(), computed("`true` with `do`, otherwise `false`"),
        "Whether the event occurs only the first time; otherwise it occurs at each crossing."},
       {"at_start", boolean(), otherwise("false"),
        "Whether the event also occurs at the start of a motion that begins with the value reached: at or above "
        "`crosses` with `direction: rising`, at or below it with `falling`."},
       {"after", name_of("event"), optional,
        "Event that has to occur before: crossings count from then on. A value that is beyond already has to come back "
        "and cross again."}}};
  return table;
}

void read_event(const std::string& name, const YamlValue& given, Model& model) {
  const YamlValue entry = given.keyed(event_keys());
  const YamlValue when = entry.at("when");
  const double value = entry.at("crosses").number();
  const EventFunction::Direction direction = read_crossing_direction(entry);
  const auto actions = entry.find("do");
  if (actions && actions->items().empty()) actions->fail("expected at least one action, such as {lock: joint}");
  if (actions && given.has("action")) given.at("action").fail("does not go with `do`: write {stop: true} there");
  const MeasureEvent::Action action = read_action(entry);
  const bool once = given.has("once") ? given.at("once").boolean() : actions.has_value();
  auto& record = static_cast<EventRecord&>(
      model.add(std::make_unique<EventRecord>(name), Entry{Section::events, name}, Recorded::no));
  if (actions || once) record.use();
  const auto planned = std::make_shared<PlannedEvent>();
  const bool at_start = entry.at("at_start").boolean();
  if (at_start && direction == EventFunction::Direction::both)
    entry.at("at_start").fail("needs `direction: rising` or `falling`: the value counts as reached beyond `crosses`");
  const auto after = entry.find("after");
  model.when_read(Model::Stage::connections, [=, &model] {
    if (after && after->text() == name) after->fail("an event that waits for itself never occurs");
    if (after) event_record_named_by(*after, model);
    if (actions)
      for (const YamlValue& item : actions->items()) plan_action(item, model, *planned);
  });
  model.when_read(Model::Stage::formulas, [=, &model, &record] {
    auto event = std::make_unique<MeasureEvent>(record, measure_named_by(when, model), value, direction, action);
    if (once) event->occur_once();
    if (at_start) event->occur_at_start();
    if (after) event->occur_after(event_record_named_by(*after, model));
    add_writes(planned->writes, *event, model);
    if (planned->stops) event->stop();
    model.add(std::move(event), Entry{Section::events, name}, Recorded::no);
  });
}

}  // namespace bielle::mechanism
