#pragma once

#include <string>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class Volume;

/// `{at, gas_volume, precharge, exponent}`. @throws InputError
void read_accumulator(const std::string& name, const YamlValue& entry, const Entry& own, Model& model);
/// The same without `at`.
void add_accumulator(const std::string& name, const YamlValue& entry, Volume& volume, const Entry& own, Model& model);

}  // namespace bielle::mechanism
