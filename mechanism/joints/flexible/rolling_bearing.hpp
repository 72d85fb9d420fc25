// Reader of ball and roller bearings (rolling_bearing_law.hpp).
#pragma once

#include "mechanism/joints/flexible/shaft_bearing.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

const KeyTable& ball_bearing_keys();
/// Reads `{type: ball_bearing, nodes, position | at, axis, elements, pitch_diameter, ball_diameter, grooves, ...}`.
void read_ball_bearing(const std::string& name, const YamlValue& entry, Model& model);
const KeyTable& roller_bearing_keys();
/// Reads `{type: roller_bearing, nodes, position | at, axis, elements, pitch_diameter, roller_length, ...}`.
void read_roller_bearing(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
