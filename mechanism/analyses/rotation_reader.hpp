// Reader of the key `rotation` of analyses of small motions.
#pragma once

#include <string>

#include "mechanism/model/model.hpp"
#include "mechanism/solvers/linearised/steady_rotation.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns the key `rotation` of an analysis.
Key rotation_key();
/// Returns the key `joint` of a rotation: the joint behind which a part turns.
Key turning_joint_key();
/// Reads its value. @throws InputError
SteadyRotation read_rotation(const YamlValue& entry, const Model& model);
/// Reads the name of a joint of two nodes. @throws InputError
std::string read_turning_joint(const YamlValue& name, const Model& model);

}  // namespace bielle::mechanism
