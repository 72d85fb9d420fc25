// Reader of `friction` of a joint: {coefficient, static, stribeck_velocity, viscous, model: coulomb | lugre |
// stick_slip, velocity, bristle_stiffness, bristle_damping, radius, arm, preload}; in joints with several sliding
// surfaces it is valid for all of them, or {angle_1: {..}, ..} gives it by coordinate.
#pragma once

#include "mechanism/joints/joint.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns the forms of `friction` of a joint.
KeyForms joint_friction_forms();

/// Adds the friction of a joint to the model, recorded with the joint. @throws InputError
void read_joint_friction(const YamlValue& value, const Joint& joint, Model& model);

}  // namespace bielle::mechanism
