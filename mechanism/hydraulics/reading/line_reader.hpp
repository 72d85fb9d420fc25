// Readers of lines of a circuit in input files: `name: {from, to, <type>: {...}}`.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/hydraulics/circuit/fluid.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns the types of lines; each is the key that creates it: orifice, laminar, check, relief, ...
std::vector<std::string> line_types();

const KeyTable& line_keys();
/// Reads one line. Its places are looked up after all entries have been read. @throws InputError
void read_line(const std::string& name, const YamlValue& entry, const Fluid& fluid, Model& model);

class PressureNode;
class SpoolValve;
class Volume;

/// Returns the place as a volume to which a chamber or accumulator can be connected, or nullptr if it is no such
/// volume.
Volume* volume_of(const PressureNode& place, const Model& model);

/// Adds the four-port valve of `servo_valve` or of an actuator.
/// @param places  places P, T, A, B
SpoolValve& add_servo_valve(const std::string& name, const YamlValue& entry,
                            const std::array<const PressureNode*, 4>& places, const Fluid& fluid, const Entry& own,
                            Model& model);
/// Adds a relief valve.
void add_relief(const std::string& name, const YamlValue& entry, const PressureNode& from, const PressureNode& to,
                const Fluid& fluid, const Entry& own, Model& model);

}  // namespace bielle::mechanism
