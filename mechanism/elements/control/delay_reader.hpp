// Reads delayed measures in the section `states`.
//
//     old:  {delayed: main.angle, time: 0.02}
// Formulas may delay measures themselves, `delay(main.angle, 0.02)`.
#pragma once

#include <string>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

Key delay_key();
const KeyTable& delay_keys();
/// Reads an entry `{delayed: measure, time: T}` of `states`, bound to delay_keys. @throws InputError
void read_delay(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
