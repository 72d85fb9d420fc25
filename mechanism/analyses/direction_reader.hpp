// Inertial directions in analyses: x, y, z or a vector.
#pragma once

#include "mechanism/math/se3.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

KeyForms direction_forms();
/// Returns the unit vector of a value of these forms. @throws InputError
Vector3 read_direction(const YamlValue& value);

}  // namespace bielle::mechanism
