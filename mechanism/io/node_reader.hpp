// Reader of the section `nodes`.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

const KeyTable& node_keys();

/// Reads the nodes, which may be placed relative to each other in any order. @throws InputError
void read_nodes(const std::vector<std::pair<std::string, YamlValue>>& entries, Model& model);

}  // namespace bielle::mechanism
