// Trees of YAML files that are made from other trees. Nodes are shared and never changed.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reduce/common/error.hpp"
#include "reduce/common/input/yaml_file.hpp"
#include "reduce/common/input/yaml_node.hpp"

namespace bielle::mechanism {

using Tree = std::shared_ptr<const YamlNode>;
using Pairs = std::vector<YamlNode::Pair>;

bool is_among(const std::string& word, const std::vector<std::string>& words);

/// Returns the value of a key, or null.
Tree find_value(const YamlNode& map, const std::string& key);
const YamlNode::Pair* find_pair(const YamlNode& map, const std::string& key);

/// Returns a scalar that stands where another node stands.
Tree make_scalar(const std::string& text, const YamlNode& place);
/// Returns a list of numbers that stands where another node stands.
Tree make_numbers(const std::vector<double>& numbers, const YamlNode& place);
Tree make_map(Pairs pairs, const YamlNode& place);
Tree make_list(std::vector<Tree> items, const YamlNode& place);
/// Returns a map without some of its keys.
Tree without(const YamlNode& map, const std::vector<std::string>& keys);
/// Returns a map in which a key has another value, with its place; a new key is the last one.
Tree with(const YamlNode& map, const std::string& key, Tree value);

/// Returns the tree, each node of which says that it stands in a file.
Tree in_file(const Tree& tree, const std::shared_ptr<const std::string>& file);

/// Returns a tree as a value whose messages name its place. @param path  in the model
YamlValue value_at(const Tree& tree, const std::string& path, const std::string& main_file);

/// @param main_file  file of nodes without a file of their own
/// @throws InputError `file:line: path: message`
[[noreturn]] void fail_at(const YamlNode& node, const std::string& main_file, const std::string& path,
                          const std::string& message);

}  // namespace bielle::mechanism
