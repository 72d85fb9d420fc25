#include "mechanism/joints/actions/event_targets.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

Joint* find_joint(const Model& model, const std::string& name) {
  const std::vector<Component*> components = model.components_of({Section::joints, name});
  return components.empty() ? nullptr : dynamic_cast<Joint*>(components.front());
}

const JointLock* find_lock(const Model& model, const Joint& joint, std::size_t coordinate) {
  for (const Component* component : model.components_of({Section::joints, joint.name()}))
    if (const auto* lock = dynamic_cast<const JointLock*>(component);
        lock && &lock->coordinate() == &joint.coordinates()[coordinate])
      return lock;
  return nullptr;
}

const JointLock& lock_of(Joint& joint, std::size_t coordinate, Model& model) {
  if (const JointLock* found = find_lock(model, joint, coordinate)) return *found;
  LockTimes never;
  never.from = std::numeric_limits<double>::infinity();
  auto made = std::make_unique<JointLock>(joint.name(), joint, coordinate, never);
  const JointLock& lock = *made;
  model.add(std::move(made), Entry{Section::joints, joint.name()});
  return lock;
}

}  // namespace

std::vector<const JointLock*> locks_named_by(const YamlValue& value, Model& model) {
  const std::string text = value.text();
  std::string name = text, coordinate;
  // "arm.knee.angle": names of joints may have dots.
  for (std::size_t end = text.size(); end != std::string::npos && !find_joint(model, name);) {
    end = end == 0 ? std::string::npos : text.rfind('.', end - 1);
    if (end == std::string::npos) break;
    name = text.substr(0, end);
    coordinate = text.substr(end + 1);
  }
  Joint* const joint = find_joint(model, name);
  if (!joint || joint->coordinates().empty()) {
    std::vector<std::string> names;
    for (const std::string& each : model.names_in(Section::joints))
      if (const Joint* other = find_joint(model, each); other && !other->coordinates().empty()) names.push_back(each);
    for (const std::string& each : model.names_in(Section::hydraulics))
      for (const Component* component : model.components_of({Section::hydraulics, each}))
        if (dynamic_cast<const Lockable*>(component)) names.push_back(each);
    value.fail(fmt::format("there is no joint with coordinates, or valve, '{}'{}", joint ? name : text,
                           did_you_mean(joint ? name : text, names)));
  }
  std::vector<std::string> coordinates;
  for (const JointCoordinate& each : joint->coordinates()) coordinates.push_back(each.name);
  if (!coordinate.empty() && std::find(coordinates.begin(), coordinates.end(), coordinate) == coordinates.end())
    value.fail(
        fmt::format("joint '{}' has no coordinate '{}'{}", name, coordinate, did_you_mean(coordinate, coordinates)));
  std::vector<const JointLock*> locks;
  for (std::size_t k = 0; k < coordinates.size(); ++k)
    if (coordinate.empty() || coordinates[k] == coordinate) locks.push_back(&lock_of(*joint, k, model));
  return locks;
}

LockableValve valve_named_by(const YamlValue& value, const Model& model) {
  const std::string name = value.text();
  const std::vector<Component*> components = model.components_of({Section::hydraulics, name});
  LockableValve found;
  for (const Component* component : components)
    if (const auto* lock = dynamic_cast<const Lockable*>(component)) found = {component, lock};
  if (components.empty() || (!found.lock && find_joint(model, name))) return {};
  if (!found.lock)
    value.fail(
        fmt::format("'{}' has no opening that could be locked: expected a joint, or a valve of type `valve`, "
                    "`servo_valve`, `check`, `relief` or `counterbalance`",
                    name));
  if (find_joint(model, name))
    value.fail(fmt::format("'{}' is a joint and a valve: give the one that is meant another name", name));
  return found;
}

const InputMeasure& input_named_by(const std::string& name, const YamlValue& value, Model& model) {
  if (const auto* input = dynamic_cast<const InputMeasure*>(model.find_measure(name))) return *input;
  std::vector<std::string> names;
  for (const std::string& each : model.announced_measures())
    if (dynamic_cast<const InputMeasure*>(model.find_measure(each))) names.push_back(each);
  value.fail(
      fmt::format("there is no input '{}'{}: write it in the section `inputs`", name, did_you_mean(name, names)));
}

}  // namespace bielle::mechanism
