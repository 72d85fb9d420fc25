#include "mechanism/joints/actions/joint_action_keys.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "mechanism/joints/actions/event_reader.hpp"
#include "mechanism/joints/actions/joint_clutch_reader.hpp"
#include "mechanism/joints/friction/friction_reader.hpp"
#include "mechanism/laws/force_law.hpp"

namespace bielle::mechanism {

const CoordinateUnits& units_of(Moves moves) {
  static constexpr CoordinateUnits along{"m", "m/s", "N", "N/m", "N s/m"},
      about{"rad", "rad/s", "N m", "N m/rad", "N m s/rad"},
      both{"m or rad", "m/s or rad/s", "N or N m", "N/m or N m/rad", "N s/m or N m s/rad"};
  return moves == Moves::slides ? along : moves == Moves::turns ? about : both;
}

namespace {

template <Moves moves>
const KeyTable& keys_of_stops() {
  using namespace keys;
  const CoordinateUnits& units = units_of(moves);
  const KeyForms end = {number(units.value), null()};
  static const KeyTable table{
      "`stops`",
      "Ends of the way of a coordinate, which push it back and never pull.",
      {{"range", tuple({end, end}), required, "Lower and upper end; one of them may be open (`~`)."},
       {"stiffness", number(units.stiffness).non_negative(), required, "Stiffness of the contact."},
       {"damping", number(units.damping).non_negative(), otherwise("0"), "Damping of the contact."}}};
  return table;
}

template <Moves moves>
const KeyTable& keys_of_lock() {
  using namespace keys;
  static const KeyTable table{
      "`locked`",
      "A lock, which keeps a coordinate at the value that it has when the lock closes.",
      {{"from",
        {number("s").non_negative(), nested(lock_event_keys)},
        otherwise("0"),
        "Time at which the lock closes, or {event: name}."},
       {"to",
        {number("s"), nested(lock_event_keys)},
        computed("the end of the run"),
        "Time at which the lock opens, or {event: name}: when that event occurs after the lock has closed."},
       {"release", number(units_of(moves).force).positive(), optional,
        "Force or torque at which the lock opens permanently; without it the lock holds any."}}};
  return table;
}

KeyForm stops_form(Moves moves) {
  return keys::nested(moves == Moves::slides  ? keys_of_stops<Moves::slides>
                      : moves == Moves::turns ? keys_of_stops<Moves::turns>
                                              : keys_of_stops<Moves::both>);
}

KeyForm lock_form(Moves moves) {
  return keys::nested(moves == Moves::slides  ? keys_of_lock<Moves::slides>
                      : moves == Moves::turns ? keys_of_lock<Moves::turns>
                                              : keys_of_lock<Moves::both>);
}

/// Returns the keys of one coordinate, with the forms of their values.
std::vector<Key> coordinate_keys(Moves moves) {
  using namespace keys;
  const CoordinateUnits& units = units_of(moves);
  const LawVariables variables{"q", "v"};
  return {
      {"stiffness", forms_of_law(units.stiffness, variables), optional,
       "Stiffness of a spring on the coordinate; or its whole resisting force, as a table over the coordinate or as a "
       "formula of q, counted from `rest`, its rate v, the time t and measures."},
      {"damping", forms_of_law(units.damping, variables), optional,
       "Damping of the coordinate; or the whole resisting force, as a table over its rate or as a formula of q, v, t "
       "and measures."},
      {"rest", number(units.value), otherwise("0"), "Value of the coordinate at which the spring is free."},
      {"preload", number(units.force), otherwise("0"), "Resisting force of the spring at `rest`."},
      {"stops", stops_form(moves), optional, "Ends of the way of the coordinate."},
      {"locked",
       {boolean(), number(), lock_form(moves)},
       optional,
       "Lock of the coordinate: `true`, or a number or formula of parameters that is not zero, locks it for the whole "
       "run."},
      {"clutch", clutch_form(moves), optional,
       "Friction clutch, brake or torque limiter on the coordinate, which holds up to a force or torque."},
      {"one_way", one_way_form(moves), optional, "One-way clutch or ratchet, which lets the coordinate move one way."},
      {"start", number(units.value), optional, "Value of the coordinate at the start of the first analysis."},
      {"start_rate", number(units.rate), optional, "Rate of the coordinate at the start of the first analysis."}};
}

/// Returns the table of a map by names of coordinates. All joints name coordinates of one kind alike.
KeyTable table_by_coordinate(const Key& sliding, const Key& turning) {
  KeyTable table{
      fmt::format("`{}`, which names coordinates", sliding.name), "Values by the names of coordinates.", {}, {}};
  for (const char* name : {"displacement", "x", "y", "z"})
    table.keys.emplace_back(name, sliding.forms, keys::optional, "Value of this coordinate.");
  for (const char* name : {"angle", "angle_1", "angle_2", "bend_x", "bend_y", "rx", "ry", "rz", "tilt_x", "tilt_y"})
    table.keys.emplace_back(name, turning.forms, keys::optional, "Value of this coordinate.");
  return table;
}

}  // namespace

std::vector<Key> joint_action_keys(Moves moves, const std::vector<std::string>& own) {
  using namespace keys;
  std::vector<Key> all = coordinate_keys(moves);
  for (Key& key : all) key.forms.push_back(entries("coordinate", key.forms));
  all.push_back({"friction", joint_friction_forms(), optional, "Friction of the sliding surfaces."});
  all.push_back({"carries", word({"all"}, "what a joint carries at the start"), optional,
                 "Parts that start as one rigid body with this joint: `all` are those behind it, with its start rates "
                 "or the rates of its drives."});
  std::erase_if(all, [&](const Key& key) { return std::find(own.begin(), own.end(), key.name) != own.end(); });
  return all;
}

const std::vector<std::string>& coordinate_key_names() {
  static const std::vector<std::string> names = keys::names_of(coordinate_keys(Moves::both));
  return names;
}

const KeyTable& by_coordinate_keys(const std::string& key) {
  static const std::map<std::string, KeyTable> tables = [] {
    std::map<std::string, KeyTable> all;
    const std::vector<Key> sliding = coordinate_keys(Moves::slides), turning = coordinate_keys(Moves::turns);
    for (std::size_t k = 0; k < sliding.size(); ++k)
      all.emplace(sliding[k].name, table_by_coordinate(sliding[k], turning[k]));
    return all;
  }();
  return tables.at(key);
}

const KeyTable& stop_keys(Moves moves) { return stops_form(moves).table(); }
const KeyTable& lock_keys(Moves moves) { return lock_form(moves).table(); }

}  // namespace bielle::mechanism
