// Readers of `clutch` and `one_way` of a coordinate.
#pragma once

#include "mechanism/joints/actions/joint_action_keys.hpp"

namespace bielle::mechanism {

KeyForm clutch_form(Moves moves);
KeyForm one_way_form(Moves moves);

/// Reads `clutch: {capacity | normal_force, coefficient, radius, surfaces; static_ratio}` and adds the clutch.
void read_clutch(const YamlValue& given, const Joint& joint, std::size_t coordinate, Model& model);
/// Reads `one_way: {direction, pitch, stiffness, damping}` and adds the one-way clutch or ratchet.
void read_one_way(const YamlValue& given, const Joint& joint, std::size_t coordinate, Model& model);

}  // namespace bielle::mechanism
