// Actions in a joint of any type: one reader for the keys of all of them.
//
//   stiffness  number, {table: file.csv}, or a formula of q, v, t and measures: resisting force   damping: similarly
//   rest       value of the coordinate at which the spring is unloaded   preload   constant force of the spring
//   stops      {range: [lower, upper], stiffness, damping}
//   locked     {from, to, release}
//   friction   of the sliding surfaces, friction_reader.hpp
//   start, start_rate   value and rate at the start of the first analysis (joint_start_reader.hpp)
// In a joint with several coordinates each key except `friction` is a map by their names.
#pragma once

#include <string>
#include <vector>

#include "mechanism/joints/actions/joint_action_keys.hpp"
#include "mechanism/joints/joint.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Adds the actions in a joint's entry to the model, recorded with the joint.
/// @param entry  bound to a table with `joint_action_keys`
/// @param own  keys among them that the joint's type reads itself (`start` of a slider) @throws InputError
void read_joint_actions(const YamlValue& entry, Joint& joint, Model& model, const std::vector<std::string>& own = {});

}  // namespace bielle::mechanism
