#include "mechanism/language/tree.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reduce/common/input/place.hpp"

namespace bielle::mechanism {
namespace {

std::shared_ptr<YamlNode> make(YamlNode::Kind kind, const YamlNode& place) {
  auto node = std::make_shared<YamlNode>();
  node->kind = kind;
  node->line = place.line;
  node->file = place.file;
  return node;
}

}  // namespace

bool is_among(const std::string& word, const std::vector<std::string>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

const YamlNode::Pair* find_pair(const YamlNode& map, const std::string& key) {
  const auto found = std::find_if(map.pairs.begin(), map.pairs.end(),
                                  [&](const YamlNode::Pair& pair) { return pair.key->scalar == key; });
  return found == map.pairs.end() ? nullptr : &*found;
}

Tree find_value(const YamlNode& map, const std::string& key) {
  const YamlNode::Pair* pair = find_pair(map, key);
  return pair ? pair->value : nullptr;
}

Tree make_scalar(const std::string& text, const YamlNode& place) {
  auto node = make(YamlNode::Kind::scalar, place);
  node->scalar = text;
  return node;
}

Tree make_numbers(const std::vector<double>& numbers, const YamlNode& place) {
  std::vector<Tree> items;
  for (const double number : numbers) items.push_back(make_scalar(fmt::format("{}", number), place));
  return make_list(std::move(items), place);
}

Tree make_map(Pairs pairs, const YamlNode& place) {
  auto node = make(YamlNode::Kind::map, place);
  node->pairs = std::move(pairs);
  return node;
}

Tree make_list(std::vector<Tree> items, const YamlNode& place) {
  auto node = make(YamlNode::Kind::sequence, place);
  node->items = std::move(items);
  return node;
}

Tree without(const YamlNode& map, const std::vector<std::string>& keys) {
  Pairs pairs;
  for (const YamlNode::Pair& pair : map.pairs)
    if (std::find(keys.begin(), keys.end(), pair.key->scalar) == keys.end()) pairs.push_back(pair);
  return make_map(std::move(pairs), map);
}

Tree with(const YamlNode& map, const std::string& key, Tree value) {
  Pairs pairs = map.pairs;
  const auto found =
      std::find_if(pairs.begin(), pairs.end(), [&](const YamlNode::Pair& pair) { return pair.key->scalar == key; });
  if (found != pairs.end())
    *found = {make_scalar(key, *value), value};
  else
    pairs.push_back({make_scalar(key, map), std::move(value)});
  return make_map(std::move(pairs), map);
}

Tree in_file(const Tree& tree, const std::shared_ptr<const std::string>& file) {
  auto copy = std::make_shared<YamlNode>(*tree);
  if (!copy->file) copy->file = file;
  for (YamlNode::Pair& pair : copy->pairs) pair = {in_file(pair.key, file), in_file(pair.value, file)};
  for (Tree& item : copy->items) item = in_file(item, file);
  return copy;
}

YamlValue value_at(const Tree& tree, const std::string& path, const std::string& main_file) {
  const Tree map = make_map({{make_scalar(path, *tree), tree}}, *tree);
  return YamlValue::of_tree(map, "", tree->file ? *tree->file : main_file).at(path);
}

void fail_at(const YamlNode& node, const std::string& main_file, const std::string& path, const std::string& message) {
  throw InputError(located_at(node.file ? *node.file : main_file, node.line, path, message));
}

}  // namespace bielle::mechanism
