// YAML text of a tree.
#pragma once

#include <string>

#include "reduce/common/input/yaml_node.hpp"

namespace bielle {

/// Writes a tree as text that parse_yaml reads as the same tree. Maps of the first two levels have a line for each key;
/// everything below stands in one line, broken at `columns`.
std::string write_yaml(const YamlNode& root, int columns = 120);

}  // namespace bielle
