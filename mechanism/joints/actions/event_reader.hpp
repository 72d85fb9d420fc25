// Events of the input file, and their actions.
#pragma once

#include <string>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

const KeyTable& event_keys();
/// Returns the keys of an item of `do`.
const KeyTable& event_action_keys();
/// Returns the keys of `locked: {from: {event: ..}}`.
const KeyTable& lock_event_keys();
/// Reads an entry of `events`. The event itself is added after the model has been read, its record at once.
/// @throws InputError
void read_event(const std::string& name, const YamlValue& given, Model& model);

}  // namespace bielle::mechanism
