// Names in input files: the nodes and components that an entry refers to.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Results are stored under the names of nodes, elements and joints, in which '/' opens a group and '.' is the group
/// itself.
/// @throws InputError for a name with an empty part or a '.' as a part
void check_name(const std::string& name, const YamlValue& entry);

/// Returns the node that a value names. @throws InputError naming the nearest name
int node_named_by(const YamlValue& value, const Model& model);

/// Returns the nodes of a value, which must be a list of exactly `count` node names.
std::vector<int> nodes_named_by(const YamlValue& value, std::size_t count, const Model& model);

/// Returns the first component of the entry of a section that a value names (drives name joints).
/// @throws InputError naming the nearest name
Component& component_named_by(Section section, const YamlValue& value, const Model& model);

/// Returns the key that names the type of an element or joint.
Key type_key();

/// Reads one entry of a section of the mechanism file (`name: {type: ..., ...}`) into the model. Each component type
/// has a reader and a table of its keys, in its own file; io/component_table lists them.
/// @param entry  bound to the table of the type's keys
using ComponentReader = void (*)(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
