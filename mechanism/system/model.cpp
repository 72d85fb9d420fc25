#include "mechanism/system/model.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mechanism/system/measure.hpp"

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

std::vector<Component*> Model::components_named(const std::string& name) const {
  std::vector<Component*> components;
  for (const Member& member : members_)
    if (member.group == "elements/" + name || member.group == "joints/" + name)
      components.push_back(member.component.get());
  return components;
}

void Model::when_read(Stage stage, std::function<void()> action) {
  waiting_[static_cast<std::size_t>(stage)].push_back(std::move(action));
}

void Model::connect() {
  for (auto& stage : waiting_) {
    // An action may add others.
    for (std::size_t k = 0; k < stage.size(); ++k) {
      const std::function<void()> action = stage[k];
      action();
    }
    stage.clear();
  }
  for (std::size_t k = 0; k < announced_.size(); ++k) find_measure(announced_[k].name);
  announced_.clear();
}

void Model::announce_measure(const std::string& name, std::function<void()> make) {
  announced_.push_back({name, std::move(make), false});
}

Measure& Model::add_measure(std::unique_ptr<Measure> measure, bool recorded) {
  Measure& added = *measure;
  measures_[added.name()] = &added;
  add(std::move(measure), recorded ? "measures" : "");
  return added;
}

const Measure* Model::find_measure(const std::string& name) {
  if (const auto found = measures_.find(name); found != measures_.end()) return found->second;
  for (std::size_t k = 0; k < announced_.size(); ++k) {
    if (announced_[k].name != name) continue;
    if (announced_[k].under_way)
      throw InputError(fmt::format("the measure '{}' refers to itself, at once or through others", name));
    announced_[k].under_way = true;
    const std::function<void()> make = announced_[k].make;
    make();
    return measures_.at(name);
  }
  return nullptr;
}

std::vector<std::string> Model::announced_measures() const {
  std::vector<std::string> names;
  for (const AnnouncedMeasure& each : announced_) names.push_back(each.name);
  return names;
}

Component& Model::component_named_by(const YamlValue& value, const std::string& section) {
  const std::string name = value.text();
  for (const Member& member : members_)
    if (member.group == section + "/" + name) return *member.component;
  value.fail(fmt::format("there is no '{}' among the {}{}", name, section, did_you_mean(name, names_in(section))));
}

}  // namespace bielle::mechanism
