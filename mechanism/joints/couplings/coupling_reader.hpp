// Readers of couplings of coordinates, rigid or elastic.
#pragma once

#include <string>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

const KeyTable& gear_keys();
const KeyTable& differential_keys();
const KeyTable& rack_and_pinion_keys();
/// Reads `gear: {joints: [a, b], ratio: rate of b over that of a}`, signed; or `teeth: [z_a, z_b]` of wheels in
/// external contact (`internal: true`: internal); or `factors: [f_1, ..]` of two or more coordinates. Each coupling
/// takes `stiffness`, with `damping` and `backlash`.
void read_gear(const std::string& name, const YamlValue& entry, Model& model);
/// Reads `differential: {joints: [input, left, right], ratio: rate of the input over the mean of the two}`
void read_differential(const std::string& name, const YamlValue& entry, Model& model);
/// Reads `rack_and_pinion: {joints: [pinion, rack], radius: displacement of the rack over the angle}`
void read_rack_and_pinion(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
