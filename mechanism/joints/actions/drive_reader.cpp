// Reads entries of `drives`.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/joints/actions/drive_keys.hpp"
#include "mechanism/joints/actions/force_drive.hpp"
#include "mechanism/joints/actions/motion_drive.hpp"
#include "mechanism/joints/actions/motor_drive.hpp"
#include "mechanism/joints/actions/pid_drive.hpp"
#include "mechanism/joints/actions/sought_drive.hpp"
#include "mechanism/measures/measure_event.hpp"
#include "mechanism/measures/read_measure.hpp"
#include "mechanism/reading/names.hpp"
#include "reduce/common/input/plausible.hpp"

namespace bielle::mechanism {
namespace {

const std::vector<std::string> drive_laws = {"angle", "rate",  "torque", "displacement",
                                             "speed", "force", "pid",    "motor"};

/// Returns whether a law is given by a map of its own that contains the coordinate; such a law may act on a coordinate
/// of any kind.
bool is_nested(const std::string& law) { return law == "pid" || law == "motor"; }

bool is_turning(const std::string& law) { return law == "angle" || law == "rate" || law == "torque"; }

/// Returns the only law of a drive.
std::string find_law(const YamlValue& entry) {
  std::string law;
  for (const std::string& key : drive_laws) {
    if (!entry.has(key)) continue;
    if (!law.empty()) entry.fail(fmt::format("a drive has one law, this one has both '{}' and '{}'", law, key));
    law = key;
  }
  if (law.empty())
    entry.fail(
        "a drive needs one of angle, rate, torque (turning joints), displacement, speed, force (sliding joints), pid "
        "or motor");
  return law;
}

/// Returns a clause that names a joint's coordinates and the laws that can drive them, for a law of the other kind,
/// which can drive none of them.
std::string coordinates_and_laws(const Joint& joint, bool turning) {
  if (joint.coordinates().empty()) return "it has no coordinate";
  std::vector<std::string> names;
  for (const JointCoordinate& coordinate : joint.coordinates()) names.push_back(fmt::format("'{}'", coordinate.name));
  const bool one = names.size() == 1;
  return fmt::format("its {} {} {} {}, `pid` or `motor`", one ? "coordinate" : "coordinates",
                     fmt::join(names, names.size() == 2 ? " and " : ", "), one ? "takes" : "take",
                     turning ? "`angle`, `rate`, `torque`" : "`displacement`, `speed`, `force`");
}

/// Returns the coordinate that a law drives. @param place  the map that may contain `coordinate`: the drive, or its
/// `pid` or `motor`
std::size_t find_coordinate(const YamlValue& entry, const YamlValue& place, const std::string& law,
                            const Joint& joint) {
  const bool any = is_nested(law), turning = is_turning(law);
  std::vector<std::string> names;
  for (const JointCoordinate& coordinate : joint.coordinates())
    if (any || (coordinate.kind != JointCoordinate::Kind::displacement) == turning) names.push_back(coordinate.name);
  if (names.empty())
    entry.at(law).fail(fmt::format("a {} joint has no {} to drive: {}", joint.type(),
                                   any       ? "coordinate"
                                   : turning ? "angle"
                                             : "displacement",
                                   coordinates_and_laws(joint, !turning)));
  if (names.size() > 1 && !place.has("coordinate"))
    place.fail(
        fmt::format("joint '{}' has several coordinates: give `coordinate`{}", joint.name(), did_you_mean("", names)));
  return joint.coordinate_index(place.has("coordinate")
                                    ? place.at("coordinate").word(names, fmt::format("a coordinate for '{}'", law))
                                    : names.front());
}

/// Returns whether a coordinate has a drive other than by a force, which permits no second one.
bool is_driven_alone(const Joint& joint, std::size_t coordinate, const Model& model) {
  const std::vector<Component*> components = model.components_of({Section::joints, joint.name()});
  return std::any_of(components.begin(), components.end(), [&](const Component* component) {
    const auto* drive = dynamic_cast<const Drive*>(component);
    return drive != nullptr && &drive->coordinate() == &joint.coordinates()[coordinate] &&
           (dynamic_cast<const PositionDrive*>(drive) != nullptr || dynamic_cast<const RateDrive*>(drive) != nullptr ||
            dynamic_cast<const SoughtDrive*>(drive) != nullptr);
  });
}

/// Records that the coordinate is driven. @param contradicts_lock  a clause on drives that permit neither a lock nor
/// another drive; nullptr for forces
void take_coordinate(const YamlValue& entry, const std::string& name, const char* contradicts_lock, Joint& joint,
                     std::size_t coordinate, const Model& model) {
  const std::string& chosen = joint.coordinates()[coordinate].name;
  Joint::CoordinateUse& use = joint.use(coordinate);
  if (!use.driver.empty() && (contradicts_lock || is_driven_alone(joint, coordinate, model)))
    entry.fail(fmt::format("the {} of joint '{}' is driven by '{}' already: only drives by forces act together", chosen,
                           joint.name(), use.driver));
  if (use.driver.empty()) use.driver = name;
  if (contradicts_lock && use.locked)
    entry.fail(
        fmt::format("the {} of joint '{}' is `locked` for a time, which {}", chosen, joint.name(), contradicts_lock));
}

/// Reads `release: 1.5`, `{event: name}` or `{when: formula, crosses: value, direction: ..}`.
void read_release(const YamlValue& value, Drive& drive, Model& model) {
  if (!value.is_map()) {
    if (!value.is_scalar()) value.fail("expected a time [s], {event: name}, or {when: .., crosses: ..}");
    return drive.release_at(value.number());
  }
  if (value.has("event") == value.has("when"))
    value.fail("a drive lets go at an `event`, or `when` a formula crosses a value: give one of the two");
  if (const auto event = value.find("event")) {
    for (const char* key : {"crosses", "direction"})
      if (value.has(key)) value.at(key).fail("belongs to `when`; an event has its own");
    // Events are read in this stage as well, but later: the action is therefore deferred once more.
    model.when_read(Model::Stage::formulas, [event = *event, &drive, &model] {
      model.when_read(Model::Stage::formulas, [event, &drive, &model] {
        const MeasureEvent& found = measure_event_named_by(event, model);
        drive.release_when(found.measure(), found.value(), found.direction());
      });
    });
    return;
  }
  const YamlValue when = value.at("when");
  const double crosses = value.at("crosses").number();
  const EventFunction::Direction direction = read_crossing_direction(value);
  model.when_read(Model::Stage::formulas, [when, crosses, direction, &drive, &model] {
    drive.release_when(measure_named_by(when, model), crosses, direction);
  });
}

std::unique_ptr<Drive> make_pid(const std::string& name, const YamlValue& entry, Joint& joint, std::size_t coordinate,
                                Model& model) {
  const PidGains gains = read_pid_gains(entry);
  double tracking_time = 0;
  const ForceLimit limit = entry.has("limit") ? read_force_limit(entry.at("limit")) : ForceLimit{};
  if (const auto tracking = entry.find("tracking_time")) {
    tracking_time = tracking->number();
    if (gains.integral == 0 || !limit.limits())
      tracking->fail("is that of the integral at a limit: give `ki` and `limit`, too");
  } else if (gains.integral != 0 && limit.limits()) {
    if (gains.proportional == 0)
      entry.fail("an integral without `kp` needs a `tracking_time` [s] in which it leaves a limit (default kp/ki)");
    tracking_time = std::abs(gains.proportional / gains.integral);
  }
  const YamlValue target = entry.at("target");
  const auto measure = entry.find("measure");
  if (measure && gains.derivative != 0 && gains.filter == 0)
    measure->fail("has a rate that is not known: give the controller a `filter` [s] for the derivative, or `kd: 0`");
  auto drive = std::make_unique<PidDrive>(name, joint, coordinate, limit, gains, tracking_time);
  model.when_read(Model::Stage::formulas,
                  [drive = drive.get(), target, measure, &model] { drive->read(target, measure, model); });
  return drive;
}

std::unique_ptr<Drive> make_force(const std::string& name, const YamlValue& entry, const YamlValue& law, Joint& joint,
                                  std::size_t coordinate, Model& model) {
  const ForceLimit limit = entry.has("limit") ? read_force_limit(entry.at("limit")) : ForceLimit{};
  auto drive = std::make_unique<ForceDrive>(name, joint, coordinate, limit);
  model.when_read(Model::Stage::formulas, [drive = drive.get(), law, &model] { drive->read(law, model); });
  return drive;
}

/// Returns whether the law is `torque: sought`.
bool is_sought(const YamlValue& law) { return law.is_scalar() && law.text() == "sought"; }

std::unique_ptr<Drive> make_sought(const std::string& name, const YamlValue& entry, const Joint& joint,
                                   std::size_t coordinate, const Model& model) {
  for (const char* key : {"limit", "release"})
    if (const auto value = entry.find(key))
      value->fail("does not go with an effort that is sought: inverse dynamics tells what the motion takes");
  std::vector<int> moves;
  if (const auto nodes = entry.find("moves")) {
    for (const YamlValue& value : nodes->is_sequence() ? nodes->items() : std::vector<YamlValue>{*nodes}) {
      moves.push_back(node_named_by(value, model));
      const auto& freedom = model.node(moves.back()).freedom;
      if (std::find(freedom.begin(), freedom.end(), Freedom::prescribed) == freedom.end())
        value.fail(
            fmt::format("node '{}' has no `motion`, which the sought effort would have to bring about", value.text()));
    }
    if (moves.empty()) nodes->fail("expected the name of a node that has a `motion`, or a list of such");
  }
  return std::make_unique<SoughtDrive>(name, joint, coordinate, std::move(moves));
}

std::unique_ptr<Drive> make_motion(const std::string& name, const std::string& law, const YamlValue& value,
                                   Joint& joint, std::size_t coordinate) {
  Expression f = value.expression();
  if (law == "angle" || law == "displacement")
    warn_of_jumps(value, f, law == "angle" ? "the angle" : "the displacement");
  if (law == "angle" || law == "displacement") joint.start_at(coordinate, f(0));
  if (law == "angle" || law == "displacement")
    return std::make_unique<PositionDrive>(name, joint, coordinate, std::move(f));
  return std::make_unique<RateDrive>(name, joint, coordinate, std::move(f));
}

}  // namespace

void read_drive(const std::string& name, const YamlValue& given, Model& model) {
  auto* joint = dynamic_cast<Joint*>(&component_named_by(Section::joints, given.at("joint"), model));
  if (!joint) given.at("joint").fail("is no joint with coordinates that can be driven");
  const std::string law = find_law(given);
  const YamlValue entry = given.keyed(drive_keys(is_nested(law)    ? Moves::both
                                                 : is_turning(law) ? Moves::turns
                                                                   : Moves::slides));
  const YamlValue value = entry.at(law);
  const bool pid = law == "pid", nested = is_nested(law), by_motion = !nested && law != "torque" && law != "force";
  const bool sought = !nested && !by_motion && is_sought(value);
  if (const auto moves = entry.find("moves"); moves && !sought)
    moves->fail("belongs to a `torque` or `force` that is `sought`");
  if (nested)
    for (const char* key : {"coordinate", "limit"})
      if (const auto outside = entry.find(key))
        outside->fail(law == "motor" && std::string(key) == "limit"
                          ? "does not go with a `motor`: limit its voltage by the formula"
                          : fmt::format("stands within `{}`", law));
  if (by_motion)
    if (const auto limit = entry.find("limit"))
      limit->fail("limits a torque or force; a drive by motion takes what the motion needs");
  const std::size_t coordinate = find_coordinate(entry, nested ? value : entry, law, *joint);
  take_coordinate(entry, name,
                  by_motion ? "a drive by motion contradicts"
                  : sought  ? "leaves no effort to be sought"
                            : nullptr,
                  *joint, coordinate, model);

  const auto controller = [&] { return value.keyed(pid_keys(moves_of(joint->coordinates()[coordinate]))); };
  std::unique_ptr<Drive> drive = pid         ? make_pid(name, controller(), *joint, coordinate, model)
                                 : nested    ? make_motor(name, value, *joint, coordinate, model)
                                 : by_motion ? make_motion(name, law, value, *joint, coordinate)
                                 : sought    ? make_sought(name, entry, *joint, coordinate, model)
                                             : make_force(name, entry, value, *joint, coordinate, model);
  if (const auto release = entry.find("release"); release && !sought) read_release(*release, *drive, model);
  model.add_within(std::move(drive), Entry{Section::drives, name}, Entry{Section::joints, joint->name()});
}

}  // namespace bielle::mechanism
