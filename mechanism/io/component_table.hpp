// Table of all component types by name: the only place where a new type is registered.
#pragma once

#include <string>
#include <vector>

#include "mechanism/reading/names.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

struct ComponentType {
  Section section;   ///< one of elements, joints, drives, loads or states
  const char* name;  ///< the entry's `type`; drives, loads and states have one type each and no `type` key
  ComponentReader read;
  const KeyTable& (*keys)();  ///< keys that an entry may contain
};

const std::vector<ComponentType>& component_table();

/// Reads one entry of a section into the model. @throws InputError for an unknown type, naming the nearest name
void read_component(Section section, const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
