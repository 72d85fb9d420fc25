// Reader of the key `rotation` of analyses of small motions.
#pragma once

#include "mechanism/solvers/linearised/steady_rotation.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns the key `rotation` of an analysis.
Key rotation_key();
/// Reads its value. @throws InputError
SteadyRotation read_rotation(const YamlValue& entry);

}  // namespace bielle::mechanism
