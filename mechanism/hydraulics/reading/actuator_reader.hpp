// Readers of hydraulic actuators: a cylinder connected to places of a circuit, or one with its own circuit.
#pragma once

#include <string>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

const KeyTable& hydraulic_actuator_keys();
/// Reads `{type: hydraulic_actuator, nodes, at, piston_areas | stages, dead_volumes, stroke, ports | pressures, ..}`.
/// An actuator without a circuit creates its own chambers, and `supply` and `valve` if they are given; their results
/// are under `/hydraulics/<name>.chamber_1`, `.valve`, ...
void read_hydraulic_actuator(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
