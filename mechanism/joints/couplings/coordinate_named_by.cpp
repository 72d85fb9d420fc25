#include "mechanism/joints/couplings/coordinate_named_by.hpp"

#include <fmt/format.h>

#include "mechanism/reading/names.hpp"

namespace bielle::mechanism {
namespace {

using Kind = JointCoordinate::Kind;

const KeyTable& coordinate_keys() {
  using namespace keys;
  static const KeyTable table{"a coordinate of a joint",
                              "A coordinate of a joint, by two names.",
                              {{"joint", name_of("joint"), required, "The joint."},
                               {"coordinate", text(), computed("the only one that fits"), "Coordinate of the joint."}}};
  return table;
}

const Joint& joint_that_can_be_coupled(const YamlValue& value, Model& model) {
  const auto* joint = dynamic_cast<const Joint*>(&component_named_by(Section::joints, value, model));
  if (!joint) value.fail("is no joint between two nodes: it has no coordinates");
  return *joint;
}

bool fits(const JointCoordinate& coordinate, std::optional<Kind> wanted) {
  return wanted ? coordinate.kind == *wanted : coordinate.kind != Kind::rotation;
}

std::vector<std::string> fitting_names(const Joint& joint, std::optional<Kind> wanted) {
  std::vector<std::string> names;
  for (const JointCoordinate& each : joint.coordinates())
    if (fits(each, wanted)) names.push_back(each.name);
  return names;
}

const char* kind_noun(std::optional<Kind> wanted) {
  return !wanted ? "coordinate that can be coupled" : *wanted == Kind::angle ? "angle" : "displacement";
}

NamedCoordinate only_coordinate(const Joint& joint, const YamlValue& value, std::optional<Kind> wanted) {
  const std::vector<std::string> names = fitting_names(joint, wanted);
  if (names.empty())
    value.fail(fmt::format("'{}' is a {} joint: it has no {}", joint.name(), joint.type(), kind_noun(wanted)));
  if (names.size() > 1)
    value.fail(fmt::format("joint '{}' has several coordinates: write '{}.{}', for example", joint.name(), joint.name(),
                           names.front()));
  return {&joint, joint.coordinate_index(names.front())};
}

NamedCoordinate coordinate_of(const Joint& joint, const std::string& coordinate, const YamlValue& value,
                              std::optional<Kind> wanted) {
  const std::vector<std::string> names = fitting_names(joint, wanted);
  for (const std::string& name : names)
    if (name == coordinate) return {&joint, joint.coordinate_index(name)};
  value.fail(fmt::format("'{}' is no {} of the {} joint '{}'{}", coordinate, kind_noun(wanted), joint.type(),
                         joint.name(), did_you_mean(coordinate, names)));
}

}  // namespace

KeyForms coordinate_forms() {
  return {keys::name_of("joint"), keys::state_formula("any", {}), keys::nested(coordinate_keys)};
}

NamedCoordinate coordinate_named_by(const YamlValue& value, Model& model, std::optional<Kind> wanted) {
  if (value.is_map()) {
    const YamlValue named = value.keyed(coordinate_keys());
    const Joint& joint = joint_that_can_be_coupled(named.at("joint"), model);
    if (const auto coordinate = named.find("coordinate"))
      return coordinate_of(joint, coordinate->text(), *coordinate, wanted);
    return only_coordinate(joint, value, wanted);
  }
  const std::string text = value.text();
  const auto dot = text.rfind('.');
  if (!model.members_of(Entry{Section::joints, text}).empty() || dot == std::string::npos)
    return only_coordinate(joint_that_can_be_coupled(value, model), value, wanted);
  const std::string name = text.substr(0, dot);
  const std::vector<Component*> named = model.components_of(Entry{Section::joints, name});
  const auto* joint = named.empty() ? nullptr : dynamic_cast<const Joint*>(named.front());
  if (!joint) {
    if (!named.empty()) value.fail(fmt::format("'{}' is no joint between two nodes: it has no coordinates", name));
    value.fail(fmt::format("there is no joint '{}'{}", name, did_you_mean(name, model.names_in(Section::joints))));
  }
  return coordinate_of(*joint, text.substr(dot + 1), value, wanted);
}

}  // namespace bielle::mechanism
