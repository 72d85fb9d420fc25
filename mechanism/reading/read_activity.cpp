#include "mechanism/reading/read_activity.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/model/sought_effort.hpp"

namespace bielle::mechanism {
namespace {

constexpr std::array releasable_sections = {Section::joints, Section::elements, Section::drives, Section::loads,
                                            Section::hydraulics};

/// Types of the hydraulics that store no fluid and have no inertia.
constexpr std::array<std::string_view, 8> releasable_lines = {"orifice",        "laminar",    "check", "relief",
                                                              "counterbalance", "flow_valve", "valve", "servo_valve"};

bool is_releasable_line(const Component& component) {
  if (dynamic_cast<const Activity*>(&component)) return true;  // an activity may belong to any entry
  return std::find(releasable_lines.begin(), releasable_lines.end(), component.type()) != releasable_lines.end();
}

/// Checks that an entry can be released, when everything has been read: it has no inertia, and no sought effort.
/// @throws InputError
void check_releasable(const YamlValue& value, const Entry& entry, const Model& model) {
  for (const Component* component : model.components_of(entry)) {
    if (entry.section == Section::hydraulics && !is_releasable_line(*component))
      value.fail(fmt::format("'{}' is no orifice or valve: of the hydraulics only these are released, and then closed",
                             entry.name));
    Declaration declaration;
    component->declare(declaration);
    if (declaration.mass || !declaration.amplitudes.empty())
      value.fail(fmt::format("'{}' has inertia and is always active; release what joins it", entry.name));
    if (dynamic_cast<const SoughtEffort*>(component))
      value.fail(fmt::format("the effort of '{}' is sought by inverse dynamics, which knows no release", entry.name));
  }
}

const Activity& checked_activity(const YamlValue& value, const Entry& entry, bool starts_active, Model& model) {
  model.when_read(Model::Stage::formulas, [value, entry, &model] { check_releasable(value, entry, model); });
  return activity_of(model, entry, starts_active);
}

}  // namespace

Key activity_key() {
  return {"active", keys::boolean(), keys::otherwise("true"),
          "`false`: the entry adds nothing until an action of an event activates it."};
}

void read_activity(const YamlValue& entry, const Entry& own, Model& model) {
  const auto active = entry.find("active");
  if (!active || active->boolean()) return;
  model.when_read(Model::Stage::connections,
                  [active = *active, own, &model] { checked_activity(active, own, false, model); });
}

const Activity& activity_named_by(const YamlValue& value, Model& model) {
  const std::string name = value.text();
  std::vector<Entry> found;
  std::vector<std::string> names, sections;
  for (const Section section : releasable_sections) {
    const std::vector<std::string>& all = model.names_in(section);
    names.insert(names.end(), all.begin(), all.end());
    const std::vector<Component*> components = model.components_of({section, name});
    if (components.empty()) continue;
    // A place of the hydraulics may have the same name as the entry that is meant.
    if (section == Section::hydraulics && !found.empty() && !is_releasable_line(*components.front())) continue;
    found.push_back({section, name});
    sections.emplace_back(section_name(section));
  }
  if (found.empty())
    value.fail(fmt::format("there is no joint, element, drive, load or valve '{}'{}", name, did_you_mean(name, names)));
  if (found.size() > 1)
    value.fail(fmt::format("'{}' stands in {}: give the one that is meant another name", name,
                           fmt::join(sections, " and in ")));
  return checked_activity(value, found.front(), true, model);
}

}  // namespace bielle::mechanism
