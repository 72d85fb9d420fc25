// Readers of coordinates of joints by their names in an analysis: `crank.angle`, `{joint: 'left arm', coordinate:
// angle}`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/model/model.hpp"
#include "mechanism/session/assembly_options.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

std::vector<std::string> names_of_coordinates(const Component& joint);

/// @param name  name of the coordinate; may be empty if the joint has only one. @throws InputError at `item`, naming
///              the nearest name
AssemblyOptions::Coordinate read_coordinate(const YamlValue& item, const Component& joint,
                                            const std::optional<std::string>& name);

const KeyTable& kept_coordinate_keys();
/// Reads `{joint: .., coordinate: ..}`; the coordinate may be omitted if there is only one.
AssemblyOptions::Coordinate read_coordinate_map(const YamlValue& item, const Model& model);

/// Returns the joint of a word "joint.coordinate", or nullptr.
const Component* joint_before_dot(const std::string& word, const Model& model);

/// Reads `hold: [shaft, crank.angle]`: all coordinates of a joint, or one. @throws InputError for a word that names no
/// coordinate, or occurs twice
std::vector<AssemblyOptions::Coordinate> read_held_coordinates(const YamlValue& hold, const Model& model);

}  // namespace bielle::mechanism
