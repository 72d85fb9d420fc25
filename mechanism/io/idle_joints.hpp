// Detection of joints without effect, because both of their nodes belong to one rigid part.
#pragma once

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Adds a warning to each joint whose nodes cannot move relative to each other without it: one rigid body carries both,
/// or both are fixed in all directions.
/// @param root  root of the whole file that the model was read from
void warn_of_idle_joints(const Model& model, const YamlValue& root);

}  // namespace bielle::mechanism
