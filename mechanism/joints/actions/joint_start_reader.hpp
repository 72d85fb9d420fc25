// Reader of `start` and `start_rate` of a joint's coordinate, and of `carries`: its value, its rate and the parts that
// move with it at the start of the first analysis.
//
// Both are conditions of that start only (mechanism/model/start_condition.hpp), with the usual zero of coordinates: the
// joint's frames coincide. An angle may be given beyond half a turn; turns are counted from it.
#pragma once

#include <optional>

#include "mechanism/joints/joint.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Adds the start conditions of a joint's entry for one of its coordinates. @param value,rate  empty: no condition
/// @throws InputError, also after all entries have been read, if a drive contradicts the condition
void read_joint_start(const std::optional<YamlValue>& value, const std::optional<YamlValue>& rate, Joint& joint,
                      std::size_t coordinate, Model& model);

/// Reads `carries: all`, with which the parts carried by the joint start as one rigid body with it
/// (mechanism/model/carried_start.hpp).
/// @throws InputError for a joint that does not have two nodes
void read_carried_start(const YamlValue& carries, const Joint& joint, Model& model);

}  // namespace bielle::mechanism
