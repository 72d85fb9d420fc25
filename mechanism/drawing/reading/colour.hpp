// Colours in input files.
#pragma once

#include <string>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Reads "#rrggbb" or the name of a colour in CSS. @returns "#rrggbb" in small letters @throws InputError
std::string read_colour(const YamlValue& value);

}  // namespace bielle::mechanism
