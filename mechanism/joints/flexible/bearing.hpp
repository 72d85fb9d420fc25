// An elastic hinge, with radial, axial and tilting stiffness and damping. It rotates freely about its axis, over any
// number of turns. The measures are those of shaft_bearing.hpp; the force is linear in the first five,
//     N = K e + D v,
// Stiffness and damping may be unsymmetric matrices, and functions of the speed of the shaft: oil films and seals
// linearised about a state of steady rotation. Cross-coupled stiffness, K_xy = -K_yx > 0, drives a forward whirl.
#pragma once

#include "mechanism/joints/flexible/shaft_bearing.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

const KeyTable& bearing_keys();
/// Reads `{type: bearing, nodes, position | at, axis, second_axis, radial, axial, tilting, matrix, film}`.
void read_bearing(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
