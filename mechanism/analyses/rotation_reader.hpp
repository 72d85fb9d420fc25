// Reader of the key `rotation` of analyses of small motions.
#pragma once

#include "mechanism/solvers/linearised/steady_rotation.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Reads `rotation: {rate: 12, axis: [0, 0, 1], position: [0, 0, 0]}`. @throws InputError
SteadyRotation read_rotation(const YamlValue& entry);

}  // namespace bielle::mechanism
