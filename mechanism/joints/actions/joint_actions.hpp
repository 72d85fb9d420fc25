// What acts in a joint, whatever its type: one reader for the keys of all of them.
//
//   stiffness  number, {table: file.csv}, or a formula of q, v, t and measures: force that resists   damping: likewise
//   rest       value of the coordinate at which the spring is free       preload   constant force of the spring
//   stops      {range: [lower, upper], stiffness, damping}
//   locked     {from, to, release}
//   friction   of the surfaces that slide, friction_reader.hpp
//   start, start_rate   value and rate where the first analysis starts (joint_start_reader.hpp)
// In a joint with several coordinates each key but `friction` is a map from their names.
#pragma once

#include <string>
#include <vector>

#include "mechanism/joints/joint.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// The keys that `read_joint_actions` reads.
std::vector<std::string> joint_action_keys();

/// Adds what the entry of a joint says of its coordinates to the model, recorded with the joint.
/// @param own  keys among them that the joint's type reads itself (`start` of a slider)
/// @throws InputError
void read_joint_actions(const YamlValue& entry, Joint& joint, Model& model, const std::vector<std::string>& own = {});

}  // namespace bielle::mechanism
