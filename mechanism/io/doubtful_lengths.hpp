// Models whose positions are in millimetres while their inertias are in kg m^2.
#pragma once

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Notes a doubt where every rigid body with two joints has them tens of metres apart and its mass next to one point.
/// @param root  of the file that the model was read from, all of it
void doubt_lengths(const Model& model, const YamlValue& root);

}  // namespace bielle::mechanism
