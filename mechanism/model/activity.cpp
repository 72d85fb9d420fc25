#include "mechanism/model/activity.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

void Activity::declare(Declaration& declaration) const {
  declaration.passive = true;
  declaration.memory = {starts_active_ ? 1.0 : 0.0};
}

void Activity::describe(const LocalState& state, Description& description) const {
  if (!is_active(state)) description.add("released: it acts when an event activates it");
}

bool Activity::knows_memory(const LocalState& state) const {
  const double active = state.memory()[0];
  return active == 0 || active == 1;
}

const Activity* find_activity(const Model& model, const Entry& entry) {
  for (const Component* component : model.components_of(entry))
    if (const auto* activity = dynamic_cast<const Activity*>(component); activity && activity->entry() == entry)
      return activity;
  return nullptr;
}

const Activity& activity_of(Model& model, const Entry& entry, bool starts_active) {
  if (const Activity* found = find_activity(model, entry)) return *found;
  auto made = std::make_unique<Activity>(entry, starts_active);
  const Activity& added = *made;
  model.add(std::move(made), entry, Recorded::no);
  return added;
}

std::vector<const Activity*> activities_of(const Model& model, const Component& component) {
  std::vector<const Activity*> found;
  for (const Member& member : model.members())
    if (const auto* activity = dynamic_cast<const Activity*>(member.component.get())) {
      const std::vector<Component*> governed = model.components_of(activity->entry());
      if (std::find(governed.begin(), governed.end(), &component) != governed.end()) found.push_back(activity);
    }
  return found;
}

Activities::Activities(const Model& model) {
  std::vector<std::vector<std::size_t>> governors(model.members().size());
  bool found = false;
  for (std::size_t a = 0; a < model.members().size(); ++a) {
    const auto* activity = dynamic_cast<const Activity*>(model.members()[a].component.get());
    if (!activity) continue;
    found = true;
    for (const std::size_t m : model.members_of(activity->entry()))
      if (!dynamic_cast<const Activity*>(model.members()[m].component.get())) governors[m].push_back(a);
  }
  if (!found) return;
  for (const std::vector<std::size_t>& of_member : governors) {
    begin_.push_back(governor_.size());
    governor_.insert(governor_.end(), of_member.begin(), of_member.end());
  }
  begin_.push_back(governor_.size());
}

bool are_units_of_forces(const std::string& units) {
  if (units == "m^3/s") return true;  // these are flows: a released line of the hydraulics has none
  static constexpr std::array<std::string_view, 4> symbols = {"N", "W", "J", "Pa"};
  // Units are symbols with exponents between spaces and slashes: "N m", "N/m", "rad/s".
  for (std::size_t begin = 0; begin < units.size();) {
    const std::size_t end = std::min(units.find_first_of(" /^", begin), units.size());
    for (const std::string_view symbol : symbols)
      if (std::string_view(units).substr(begin, end - begin) == symbol) return true;
    begin = end + 1;
  }
  return false;
}

}  // namespace bielle::mechanism
