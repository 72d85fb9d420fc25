#include "mechanism/system/model.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bielle::mechanism {

Model::Model() {
  Node ground;
  ground.name = "ground";
  ground.freedom.fill(Freedom::fixed);
  add_node(std::move(ground));
}

int Model::add_node(Node node) {
  const int index = static_cast<int>(nodes_.size());
  if (!node_index_.emplace(node.name, index).second)
    throw InputError(fmt::format("there are two nodes named '{}'", node.name));
  nodes_.push_back(std::move(node));
  return index;
}

std::optional<int> Model::find_node(const std::string& name) const {
  const auto found = node_index_.find(name);
  return found == node_index_.end() ? std::nullopt : std::optional<int>(found->second);
}

int Model::node_named_by(const YamlValue& value) const {
  const std::string name = value.text();
  if (const auto index = find_node(name)) return *index;
  std::vector<std::string> names;
  for (const Node& node : nodes_)
    if (!node.internal) names.push_back(node.name);
  value.fail(fmt::format("there is no node '{}'{}", name, did_you_mean(name, names)));
}

std::vector<int> Model::nodes_named_by(const YamlValue& value, std::size_t count) const {
  const std::vector<YamlValue> items = value.items();
  if (items.size() != count) value.fail(fmt::format("expected {} node names, found {}", count, items.size()));
  std::vector<int> nodes;
  for (const YamlValue& item : items) nodes.push_back(node_named_by(item));
  return nodes;
}

Component& Model::add(std::unique_ptr<Component> component, const std::string& group, bool stacked) {
  members_.push_back({std::move(component), group, stacked});
  return *members_.back().component;
}

std::vector<std::string> Model::names_in(const std::string& section) const {
  std::vector<std::string> names;
  for (const Member& member : members_) {
    if (member.group.rfind(section + "/", 0) != 0) continue;
    const std::string name = member.group.substr(section.size() + 1);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

std::vector<Component*> Model::components_in(const std::string& group) {
  std::vector<Component*> components;
  for (const Member& member : members_)
    if (member.group == group) components.push_back(member.component.get());
  return components;
}

Component& Model::component_named_by(const YamlValue& value, const std::string& section) {
  const std::string name = value.text();
  for (const Member& member : members_)
    if (member.group == section + "/" + name) return *member.component;
  value.fail(fmt::format("there is no '{}' among the {}{}", name, section, did_you_mean(name, names_in(section))));
}

}  // namespace bielle::mechanism
