// Targets of the actions of events: locks of joints and valves, and inputs.
#pragma once

#include <vector>

#include "mechanism/joints/actions/joint_lock.hpp"
#include "mechanism/measures/input_measure.hpp"
#include "mechanism/model/lockable.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns the locks of the coordinates that a value names: "knee" or "knee.angle". Coordinates without a lock get one
/// that only events close. @throws InputError naming the nearest name
std::vector<const JointLock*> locks_named_by(const YamlValue& value, Model& model);

/// Component of the hydraulics that a value names, if its opening can be locked; nullptr if the value names a joint, or
/// no component of the hydraulics. @throws InputError if a joint and a component both have the name, or if the
/// component has no opening that can be locked
struct LockableValve {
  const Component* component = nullptr;
  const Lockable* lock = nullptr;
};
LockableValve valve_named_by(const YamlValue& value, const Model& model);

/// Returns the input with a name. @throws InputError naming the nearest name
const InputMeasure& input_named_by(const std::string& name, const YamlValue& value, Model& model);

}  // namespace bielle::mechanism
