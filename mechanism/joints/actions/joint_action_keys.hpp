// Tables of the keys of actions in joints, with units by the kind of coordinate.
#pragma once

#include <string>
#include <vector>

#include "mechanism/joints/joint.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// The coordinates of a joint type, which determine the units of its keys: displacements, angles, or both.
enum class Moves { slides, turns, both };

/// Returns the kind of one coordinate.
inline Moves moves_of(const JointCoordinate& coordinate) {
  return coordinate.kind == JointCoordinate::Kind::displacement ? Moves::slides : Moves::turns;
}

/// SI units of a coordinate and of what acts on it.
struct CoordinateUnits {
  const char *value, *rate, *force, *stiffness, *damping;
};
const CoordinateUnits& units_of(Moves moves);

/// Returns the keys that `read_joint_actions` reads. @param own  keys that the joint's type does not have, or reads
/// itself (`start` of a slider)
std::vector<Key> joint_action_keys(Moves moves, const std::vector<std::string>& own = {});

/// Returns the names of the keys whose values belong to one coordinate.
const std::vector<std::string>& coordinate_key_names();

/// Returns the table of the map from names of coordinates to values of one of these keys, with the units of each.
const KeyTable& by_coordinate_keys(const std::string& key);

/// Returns the tables of `stops` and `locked` of a coordinate.
const KeyTable& stop_keys(Moves moves);
const KeyTable& lock_keys(Moves moves);

}  // namespace bielle::mechanism
