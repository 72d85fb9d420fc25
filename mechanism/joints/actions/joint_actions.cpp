#include "mechanism/joints/actions/joint_actions.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "mechanism/joints/actions/event_reader.hpp"
#include "mechanism/joints/actions/joint_clutch_reader.hpp"
#include "mechanism/joints/actions/joint_lock.hpp"
#include "mechanism/joints/actions/joint_spring.hpp"
#include "mechanism/joints/actions/joint_start_reader.hpp"
#include "mechanism/joints/actions/joint_stop.hpp"
#include "mechanism/joints/friction/friction_reader.hpp"

namespace bielle::mechanism {
namespace {

/// Values of the keys for each coordinate: the value itself in a joint with one coordinate, otherwise a map by their
/// names.
using ByKey = std::map<std::string, YamlValue>;

/// Returns whether a map contains names of coordinates; otherwise it is the value of the only coordinate.
bool names_coordinates(const YamlValue& value, const std::vector<std::string>& names) {
  return value.is_map() &&
         std::any_of(names.begin(), names.end(), [&](const std::string& name) { return value.has(name); });
}

std::vector<ByKey> sort_by_coordinate(const YamlValue& entry, const Joint& joint, const std::vector<std::string>& own) {
  std::vector<std::string> names;
  for (const JointCoordinate& each : joint.coordinates()) names.push_back(each.name);
  std::vector<ByKey> sorted(names.size());
  for (const std::string& key : coordinate_key_names()) {
    const auto value = entry.find(key);
    if (!value || std::find(own.begin(), own.end(), key) != own.end()) continue;
    if (names.empty()) value->fail(fmt::format("a {} joint has no coordinate on which it could act", joint.type()));
    if (names.size() == 1 && !names_coordinates(*value, names)) {
      sorted.front().emplace(key, *value);
      continue;
    }
    if (!value->is_map())
      value->fail(fmt::format("a {} joint has several coordinates: give {{{}: ...}}", joint.type(), names.front()) +
                  did_you_mean("", names));
    value->check_keys(names, fmt::format("`{}`, which names coordinates", key));
    for (const auto& [name, of_coordinate] : value->keyed(by_coordinate_keys(key)).entries())
      sorted[joint.coordinate_index(name)].emplace(key, of_coordinate);
  }
  return sorted;
}

std::optional<YamlValue> find(const ByKey& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? std::nullopt : std::optional(found->second);
}

void read_spring(const ByKey& values, const Joint& joint, std::size_t coordinate, Model& model) {
  const auto stiffness = find(values, "stiffness"), damping = find(values, "damping"), rest = find(values, "rest"),
             preload = find(values, "preload");
  if (rest && !stiffness) rest->fail("is where a spring is free: give its `stiffness`, too");
  if (!stiffness && !damping && !preload) return;
  auto spring = std::make_unique<JointSpring>(joint.name(), joint, coordinate, rest ? rest->number() : 0,
                                              preload ? preload->number() : 0);
  model.when_read(Model::Stage::formulas, [spring = spring.get(), stiffness, damping, &model] {
    if (stiffness) spring->read(*stiffness, false, model);
    if (damping) spring->read(*damping, true, model);
  });
  model.add(std::move(spring), Entry{Section::joints, joint.name()});
}

StopLaw read_stop_range(const YamlValue& given, Moves moves) {
  const YamlValue entry = given.keyed(stop_keys(moves));
  const YamlValue range = entry.at("range");
  if (!range.is_sequence() || range.size() != 2) range.fail("expected [lower, upper]");
  // One end may be open (`~`).
  const auto end = [&](std::size_t k, double open) { return range.at(k).is_null() ? open : range.at(k).number(); };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  StopLaw stops{end(0, -infinity), end(1, infinity), entry.at("stiffness").number(), entry.at("damping").number()};
  if (!(stops.lower < stops.upper)) range.fail("expected the lower end first, and a range between the two");
  if (stops.lower == -infinity && stops.upper == infinity) range.fail("both ends are open: these are no stops");
  return stops;
}

LockTimes read_lock_times(const YamlValue& given, Moves moves) {
  if (given.is_scalar()) return {};  // always locked
  if (!given.is_map()) given.fail("expected `true`, or times: {from, to, release}");
  const YamlValue entry = given.keyed(lock_keys(moves));
  LockTimes times;
  const YamlValue from = entry.at("from");
  times.from = from.is_map() ? std::numeric_limits<double>::infinity() : from.number();
  if (const auto to = entry.find("to"); to && !to->is_map()) {
    times.to = to->number();
    if (!from.is_map() && times.to <= times.from) to->fail("expected a time after `from`");
  }
  if (const auto release = entry.find("release")) times.release = release->number();
  return times;
}

/// Reads the events that close and open a lock instead of times.
void read_lock_events(const YamlValue& given, Moves moves, JointLock& lock, Model& model) {
  if (!given.is_map()) return;
  const YamlValue entry = given.keyed(lock_keys(moves));
  for (const char* key : {"from", "to"}) {
    const auto end = entry.find(key);
    if (!end || !end->is_map()) continue;
    const YamlValue event = end->keyed(lock_event_keys()).at("event");
    model.when_read(Model::Stage::connections, [event, closes = key == std::string("from"), &lock, &model] {
      EventRecord& record = event_record_named_by(event, model);
      closes ? lock.close_at(record) : lock.open_at(record);
    });
  }
}

}  // namespace

void read_joint_actions(const YamlValue& entry, Joint& joint, Model& model, const std::vector<std::string>& own) {
  const Entry of_joint{Section::joints, joint.name()};
  const std::vector<ByKey> sorted = sort_by_coordinate(entry, joint, own);
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    const Moves moves = moves_of(joint.coordinates()[k]);
    read_spring(sorted[k], joint, k, model);
    if (const auto stops = find(sorted[k], "stops")) {
      if (joint.coordinates()[k].kind == JointCoordinate::Kind::rotation)
        stops->fail("a component of a rotation vector has no stops; take a joint with angles");
      model.add(std::make_unique<JointStop>(joint.name(), joint, k, read_stop_range(*stops, moves)), of_joint);
    }
    if (const auto locked = find(sorted[k], "locked"); locked && (!locked->is_scalar() || locked->boolean())) {
      const LockTimes times = read_lock_times(*locked, moves);
      auto lock = std::make_unique<JointLock>(joint.name(), joint, k, times);
      if (const auto start = find(sorted[k], "start"); start && times.from == 0) lock->close_at(start->number());
      read_lock_events(*locked, moves, *lock, model);
      model.add(std::move(lock), of_joint);
      joint.use(k).locked = true;
      if (const auto rate = find(sorted[k], "start_rate"); rate && times.from == 0)
        rate->fail("the coordinate is `locked` from the beginning: it has no rate");
    }
    if (const auto clutch = find(sorted[k], "clutch")) read_clutch(*clutch, joint, k, model);
    if (const auto one_way = find(sorted[k], "one_way")) read_one_way(*one_way, joint, k, model);
    read_joint_start(find(sorted[k], "start"), find(sorted[k], "start_rate"), joint, k, model);
  }
  if (const auto carries = entry.find("carries")) read_carried_start(*carries, joint, model);
  const bool takes_friction = std::find(own.begin(), own.end(), "friction") == own.end();
  if (const auto friction = entry.find("friction"); friction && takes_friction)
    read_joint_friction(*friction, joint, model);
}

}  // namespace bielle::mechanism
