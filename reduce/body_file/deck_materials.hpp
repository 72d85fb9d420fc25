// `materials: from_file`: the materials of the Nastran, Abaqus or CalculiX file that is the body's geometry.
#pragma once

#include <string>
#include <vector>

#include "reduce/body_file/body_file.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

/// Returns the units of mass that a body file may name, for the values of a deck.
std::vector<std::string> mass_units();
/// Returns the number of kilograms in one of these units.
double kilograms_per(const std::string& unit);

/// Reads the materials of the geometry's file, whose values have its `length_unit`, the body file's `mass_unit` and
/// seconds, and the regions that the file gives them. Notes of the reader become warnings.
/// @param root  the body file @returns volume group -> name of a material
/// @throws InputError at the key `materials`
std::map<std::string, std::string> read_deck_materials(const YamlValue& root, BodyFile& body);

}  // namespace bielle::reduce
