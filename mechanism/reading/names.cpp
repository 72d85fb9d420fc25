#include "mechanism/reading/names.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bielle::mechanism {

void check_name(const std::string& name, const YamlValue& entry) {
  if (name.empty()) entry.fail("a name must not be empty");
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    const std::string part = name.substr(begin, end - begin);
    if (part.empty() || part == ".")
      entry.fail(
          fmt::format("'{}' is no name: results stand under it, and neither nothing nor '.' may stand between "
                      "its '/'",
                      name));
    begin = end + 1;
  }
}

Key type_key() { return {"type", keys::text(), keys::required, "The type of the entry."}; }

int node_named_by(const YamlValue& value, const Model& model) {
  const std::string name = value.text();
  if (const auto index = model.find_node(name)) return *index;
  std::vector<std::string> names;
  for (const Node& node : model.nodes())
    if (!node.internal) names.push_back(node.name);
  value.fail(fmt::format("there is no node '{}'{}", name, did_you_mean(name, names)));
}

std::vector<int> nodes_named_by(const YamlValue& value, std::size_t count, const Model& model) {
  const std::vector<YamlValue> items = value.items();
  if (items.size() != count) value.fail(fmt::format("expected {} node names, found {}", count, items.size()));
  std::vector<int> nodes;
  for (const YamlValue& item : items) nodes.push_back(node_named_by(item, model));
  return nodes;
}

Component& component_named_by(Section section, const YamlValue& value, const Model& model) {
  const std::string name = value.text();
  const std::vector<std::size_t>& members = model.members_of({section, name});
  if (!members.empty()) return *model.members()[members.front()].component;
  value.fail(fmt::format("there is no '{}' among the {}{}", name, section_name(section),
                         did_you_mean(name, model.names_in(section))));
}

}  // namespace bielle::mechanism
