#pragma once

#include <string>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class Volume;

const KeyTable& accumulator_keys();
/// Returns the keys of an accumulator of an actuator: those of a circuit's accumulator, without `at`.
const KeyTable& own_accumulator_keys();
/// Reads an accumulator of a circuit. @throws InputError
void read_accumulator(const std::string& name, const YamlValue& entry, const Entry& own, Model& model);
/// Adds an accumulator at a volume.
void add_accumulator(const std::string& name, const YamlValue& entry, Volume& volume, const Entry& own, Model& model);

}  // namespace bielle::mechanism
