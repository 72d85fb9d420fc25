// All component types by name: the one place where a new type is registered.
#pragma once

#include <string>
#include <vector>

#include "mechanism/system/model.hpp"

namespace bielle::mechanism {

/// Sections of a mechanism file that hold components.
enum class Section { elements, joints, drives, loads };

struct ComponentType {
  Section section;
  const char* name;  ///< the entry's `type`; drives and loads have one type each and no `type` key
  ComponentReader read;
};

const std::vector<ComponentType>& component_table();
const char* section_name(Section section);

/// Reads one entry of a section into the model. @throws InputError for an unknown type, with the nearest name
void read_component(Section section, const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
