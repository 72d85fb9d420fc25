// Reader of the key `rotation` of analyses of small motions.
#pragma once

#include <string>

#include "mechanism/model/model.hpp"
#include "mechanism/solvers/linearised/steady_rotation.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns the key `rotation` of an analysis.
Key rotation_key();
/// Returns the key `joint` of a rotation: the joint that drives the turning part.
Key turning_joint_key();
/// Returns the key `state` of such a rotation: `periodic` or `mean`.
Key turning_state_key();
/// Tells whether the state of a rotation behind a joint is the mean one.
bool read_mean(const YamlValue& rotation);
/// Reads its value. @throws InputError
SteadyRotation read_rotation(const YamlValue& entry, const Model& model);
/// Reads the name of a joint of two nodes. @throws InputError
std::string read_turning_joint(const YamlValue& name, const Model& model);

}  // namespace bielle::mechanism
