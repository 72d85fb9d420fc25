// Reader of the section `hydraulics` of a mechanism file: circuits that actuators share.
#pragma once

#include <string>
#include <vector>

#include "mechanism/hydraulics/circuit/fluid.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

const KeyTable& hydraulics_keys();
/// Reads places (volumes, junctions, supplies) and the components that connect them (lines, accumulators, machines).
/// Call it before elements are read: actuators name places.
/// @throws InputError
void read_hydraulics(const YamlValue& section, Model& model);

/// Returns the types of entries: volume, supply, accumulator, machine, and those of lines.
std::vector<std::string> circuit_types();

}  // namespace bielle::mechanism
