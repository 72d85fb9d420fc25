#pragma once

#include <string>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class Volume;

/// Reads `{at, gas_volume, precharge, exponent}`. @throws InputError
void read_accumulator(const std::string& name, const YamlValue& entry, const Entry& own, Model& model);
/// Reads the same without `at`.
void add_accumulator(const std::string& name, const YamlValue& entry, Volume& volume, const Entry& own, Model& model);

}  // namespace bielle::mechanism
