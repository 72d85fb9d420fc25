#include "mechanism/model/model.hpp"

#include <fmt/format.h>

#include "mechanism/model/measure.hpp"

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

int Model::root_carrier(int node) const {
  // (Carriers in a circle are reported as an error when all of the model has been read.)
  for (std::size_t k = 0; nodes_[static_cast<std::size_t>(node)].carrier && k < nodes_.size(); ++k)
    node = *nodes_[static_cast<std::size_t>(node)].carrier;
  return node;
}

Component& Model::add(std::unique_ptr<Component> component, const Entry& entry, Recorded recorded) {
  add_to_index(entry, members_.size());
  members_.push_back({std::move(component), entry, entry, recorded});
  return *members_.back().component;
}

Component& Model::add_within(std::unique_ptr<Component> component, const Entry& entry, const Entry& within) {
  add_to_index(entry, members_.size());
  add_to_index(within, members_.size());
  members_.push_back({std::move(component), entry, within, Recorded::alone});
  return *members_.back().component;
}

void Model::add_to_index(const Entry& entry, std::size_t member) {
  const auto [place, added] = members_of_.try_emplace(entry);
  if (added) names_[static_cast<std::size_t>(entry.section)].push_back(entry.name);
  place->second.push_back(member);
}

const std::vector<std::size_t>& Model::members_of(const Entry& entry) const {
  static const std::vector<std::size_t> none;
  const auto found = members_of_.find(entry);
  return found == members_of_.end() ? none : found->second;
}

std::vector<Component*> Model::components_of(const Entry& entry) const {
  std::vector<Component*> components;
  for (const std::size_t member : members_of(entry)) components.push_back(members_[member].component.get());
  return components;
}

std::vector<Component*> Model::components_named(const std::string& name) const {
  std::vector<Component*> components = components_of({Section::elements, name});
  const std::vector<Component*> of_joint = components_of({Section::joints, name});
  components.insert(components.end(), of_joint.begin(), of_joint.end());
  const std::vector<Component*> of_hydraulics = components_of({Section::hydraulics, name});
  components.insert(components.end(), of_hydraulics.begin(), of_hydraulics.end());
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
  for (std::size_t k = 0; k < announced_.size(); ++k) {
    const std::string name = announced_[k].name;  // a copy, because creating a measure may announce others
    find_measure(name);
  }
  announced_.clear();
  announced_index_.clear();
}

void Model::announce_measure(const std::string& name, std::function<void()> make) {
  announced_index_.try_emplace(name, announced_.size());
  announced_.push_back({name, std::move(make), false});
}

std::vector<std::string> Model::announced_measures() const {
  std::vector<std::string> names;
  for (const auto& [name, place] : announced_index_) names.push_back(name);
  return names;
}

Measure& Model::add_measure(std::unique_ptr<Measure> measure, bool recorded) {
  const Entry entry{Section::measures, measure->name()};
  return add_measure_of(entry, std::move(measure), recorded);
}

Measure& Model::add_measure_of(const Entry& entry, std::unique_ptr<Measure> measure, bool recorded) {
  Measure& added = *measure;
  measures_[added.name()] = &added;
  const Entry results{Section::measures, added.name()};
  if (entry == results)
    add(std::move(measure), entry, recorded ? Recorded::alone : Recorded::no);
  else
    add_within(std::move(measure), entry, results);
  members_.back().recorded = recorded ? Recorded::alone : Recorded::no;
  return added;
}

const Measure* Model::find_measure(const std::string& name) {
  if (const auto found = measures_.find(name); found != measures_.end()) return found->second;
  const auto place = announced_index_.find(name);
  if (place == announced_index_.end()) return nullptr;
  AnnouncedMeasure& announced = announced_[place->second];
  if (announced.under_way)
    throw InputError(fmt::format("the measure '{}' refers to itself, at once or through others", name));
  announced.under_way = true;
  const std::function<void()> make = announced.make;  // a copy, because it may announce other measures
  make();
  return measures_.at(name);
}

}  // namespace bielle::mechanism
