// Coordinates of joints by their names in an analysis: `crank.angle`, `{joint: 'left arm', coordinate: angle}`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/model/model.hpp"
#include "mechanism/session/assembly_options.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

std::vector<std::string> names_of_coordinates(const Component& joint);

/// @param name  of the coordinate; none: it is the only one. @throws InputError at `item`, with the nearest name
AssemblyOptions::Coordinate read_coordinate(const YamlValue& item, const Component& joint,
                                            const std::optional<std::string>& name);

/// `{joint: .., coordinate: ..}`, the coordinate left out where there is one only.
AssemblyOptions::Coordinate read_coordinate_map(const YamlValue& item, const std::string& key, const Model& model);

/// The joint of a word "joint.coordinate", or nullptr.
const Component* joint_before_dot(const std::string& word, const Model& model);

/// `hold: [shaft, crank.angle]`: all coordinates of a joint, or one. @throws InputError for what is none, or stands
/// twice
std::vector<AssemblyOptions::Coordinate> read_held_coordinates(const YamlValue& hold, const Model& model);

}  // namespace bielle::mechanism
