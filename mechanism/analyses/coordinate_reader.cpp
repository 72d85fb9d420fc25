#include "mechanism/analyses/coordinate_reader.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "mechanism/model/start_coordinates.hpp"
#include "mechanism/reading/names.hpp"

namespace bielle::mechanism {

std::vector<std::string> names_of_coordinates(const Component& component) {
  std::vector<std::string> names;
  for (const StartCoordinate& each : start_coordinates_of(component)) names.push_back(each.name);
  return names;
}

AssemblyOptions::Coordinate read_coordinate(const YamlValue& item, const Component& joint,
                                            const std::optional<std::string>& name) {
  const std::vector<std::string> names = names_of_coordinates(joint);
  if (names.empty())
    item.fail(fmt::format("joint '{}' ({}) has no coordinate to keep or to hold", joint.name(), joint.type()));
  if (!name && names.size() > 1)
    item.fail(
        fmt::format("joint '{}' has several coordinates: give `coordinate`{}", joint.name(), did_you_mean("", names)));
  const std::string wanted = name.value_or(names.front());
  const auto found = std::find(names.begin(), names.end(), wanted);
  if (found == names.end())
    item.fail(fmt::format("joint '{}' has no coordinate '{}'{}", joint.name(), wanted, did_you_mean(wanted, names)));
  return {&joint, static_cast<std::size_t>(found - names.begin())};
}

/// Returns the joint of a word "joint.coordinate", or nullptr.
const Component* joint_before_dot(const std::string& word, const Model& model) {
  const std::size_t dot = word.rfind('.');
  if (dot == std::string::npos) return nullptr;
  const std::vector<std::size_t>& members = model.members_of({Section::joints, word.substr(0, dot)});
  return members.empty() ? nullptr : model.members()[members.front()].component.get();
}

const KeyTable& kept_coordinate_keys() {
  using namespace keys;
  static const KeyTable table{
      "a coordinate that keeps its value",
      "A coordinate of a joint.",
      {{"joint", name_of("joint"), required, "The joint."},
       {"coordinate", text(), computed("the only coordinate of the joint"), "Name of the coordinate."}}};
  return table;
}

AssemblyOptions::Coordinate read_coordinate_map(const YamlValue& item, const Model& model) {
  const Component& joint = component_named_by(Section::joints, item.at("joint"), model);
  const auto coordinate = item.find("coordinate");
  return read_coordinate(coordinate ? *coordinate : item, joint,
                         coordinate ? std::optional(coordinate->text()) : std::nullopt);
}

namespace {

void read_held(const YamlValue& item, const Model& model, std::vector<AssemblyOptions::Coordinate>& held) {
  if (item.is_map()) {
    held.push_back(read_coordinate_map(item, model));
    return;
  }
  const std::string word = item.text();
  if (model.members_of({Section::joints, word}).empty())
    if (const Component* joint = joint_before_dot(word, model)) {
      held.push_back(read_coordinate(item, *joint, word.substr(word.rfind('.') + 1)));
      return;
    }
  const Component& joint = component_named_by(Section::joints, item, model);
  const std::size_t count = start_coordinates_of(joint).size();
  if (count == 0) item.fail(fmt::format("joint '{}' ({}) has no coordinate to hold", joint.name(), joint.type()));
  for (std::size_t k = 0; k < count; ++k) held.push_back({&joint, k});
}

}  // namespace

std::vector<AssemblyOptions::Coordinate> read_held_coordinates(const YamlValue& hold, const Model& model) {
  std::vector<AssemblyOptions::Coordinate> held;
  std::set<std::pair<const Component*, std::size_t>> seen;
  for (const YamlValue& item : hold.items()) {
    const std::size_t before = held.size();
    read_held(item, model, held);
    for (std::size_t k = before; k < held.size(); ++k)
      if (!seen.emplace(held[k].component, held[k].coordinate).second) item.fail("stands in this list twice");
  }
  return held;
}

}  // namespace bielle::mechanism
