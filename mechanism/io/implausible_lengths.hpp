// Detection of models whose positions are in millimetres while their inertias are in kg m^2.
#pragma once

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Adds a warning if every rigid body with two joints has them tens of metres apart and its mass near one point.
/// @param root  root of the whole file that the model was read from
void warn_of_lengths(const Model& model, const YamlValue& root);

}  // namespace bielle::mechanism
