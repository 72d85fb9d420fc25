// `start` and `start_rate` of a joint's coordinate, and `carries`: where it stands, how fast it goes and what goes with
// it when the first analysis starts.
//
// Both are conditions of that start alone (mechanism/model/start_condition.hpp), and count as coordinates always do:
// zero where the joint's frames coincide. An angle may be given beyond half a turn; turns are counted from there.
#pragma once

#include <optional>

#include "mechanism/joints/joint.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Notes what the entry of a joint asks of one of its coordinates. @param value,rate  empty: nothing is asked
/// @throws InputError, also when all entries are read and a drive says otherwise
void read_joint_start(const std::optional<YamlValue>& value, const std::optional<YamlValue>& rate, Joint& joint,
                      std::size_t coordinate, Model& model);

/// `carries: all`: what is behind the joint starts with it as one rigid body (mechanism/model/carried_start.hpp).
/// @throws InputError for a joint of other than two nodes
void read_carried_start(const YamlValue& carries, const Joint& joint, Model& model);

}  // namespace bielle::mechanism
