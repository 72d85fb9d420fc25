// Hydraulic actuators in input files: a cylinder that joins places of a circuit, or one with a circuit of its own.
#pragma once

#include <string>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// `{type: hydraulic_actuator, nodes, at, piston_areas | stages, dead_volumes, stroke, ports | pressures, ..}`.
/// A lone one makes its own chambers, and `supply` and `valve` where they are given; they stand in the results under
/// `/hydraulics/<name>.chamber_1`, `.valve`, ...
void read_hydraulic_actuator(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
