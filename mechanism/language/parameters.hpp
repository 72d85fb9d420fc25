// Parameters of a mechanism file.
#pragma once

#include <map>
#include <string>

#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Evaluates a number with or without a unit, or a formula. @throws InputError without file or line
double evaluate(const std::string& number, const Parameters& parameters);

/// Evaluates the parameters; each may use those written before it, and have a unit.
/// @param root       bound to its table
/// @param overrides  formulas in place of those of the file, by names (`--set`)
/// @throws InputError for a wrong formula, and for an override without a parameter
Parameters read_parameters(YamlValue root, const std::map<std::string, std::string>& overrides);

}  // namespace bielle::mechanism
