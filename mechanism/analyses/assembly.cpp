// `assembly`: positions and velocities are made consistent, and recorded.
//
// `keep`: nodes that stay where they are, and coordinates of joints that keep their value:
//     keep: [base, crank.angle, {joint: 'left arm', coordinate: angle}]
// A word is the name of a node; otherwise that of a joint, with its coordinate behind the last dot. A map may leave the
// coordinate out where there is one only.
#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/analyses/summary_text.hpp"
#include "mechanism/reading/names.hpp"

namespace bielle::mechanism {
namespace {

class AssemblyAnalysis : public Analysis {
 public:
  explicit AssemblyAnalysis(AssemblyOptions options) : Analysis("assembly"), options_(std::move(options)) {}
  std::size_t expected_rows(const Recording&) const override { return 1; }
  AssemblyOptions kept() const override { return options_; }

 private:
  void solve(Session& session, AnalysisSummary& summary) const override {
    const StartReport start = session.assemble(options_);
    summary.records = session.rows();
    summary.text = type() + "\n" + format_start(start) + format_mobility(session);
  }
  AssemblyOptions options_;
};

std::vector<std::string> names_of_coordinates(const Component& component) {
  std::vector<std::string> names;
  for (const StartCoordinate& each : component.start_coordinates()) names.push_back(each.name);
  return names;
}

AssemblyOptions::Coordinate read_coordinate(const YamlValue& item, const Component& joint,
                                            const std::optional<std::string>& name) {
  const std::vector<std::string> names = names_of_coordinates(joint);
  if (names.empty()) item.fail(fmt::format("joint '{}' ({}) has no coordinate to keep", joint.name(), joint.type()));
  if (!name && names.size() > 1)
    item.fail(
        fmt::format("joint '{}' has several coordinates: give `coordinate`{}", joint.name(), did_you_mean("", names)));
  const std::string wanted = name.value_or(names.front());
  const auto found = std::find(names.begin(), names.end(), wanted);
  if (found == names.end())
    item.fail(fmt::format("joint '{}' has no coordinate '{}'{}", joint.name(), wanted, did_you_mean(wanted, names)));
  return {&joint, static_cast<std::size_t>(found - names.begin())};
}

/// The joint of a word "joint.coordinate", or nullptr.
const Component* joint_before_dot(const std::string& word, const Model& model) {
  const std::size_t dot = word.rfind('.');
  if (dot == std::string::npos) return nullptr;
  const std::vector<std::size_t>& members = model.members_of({Section::joints, word.substr(0, dot)});
  return members.empty() ? nullptr : model.members()[members.front()].component.get();
}

void read_kept(const YamlValue& item, const Model& model, AssemblyOptions& options) {
  if (item.is_map()) {
    item.check_keys({"joint", "coordinate"}, "`keep`, which names a node or a coordinate of a joint");
    const Component& joint = component_named_by(Section::joints, item.at("joint"), model);
    const auto coordinate = item.find("coordinate");
    options.kept_coordinates.push_back(read_coordinate(coordinate ? *coordinate : item, joint,
                                                       coordinate ? std::optional(coordinate->text()) : std::nullopt));
    return;
  }
  const std::string word = item.text();
  if (const auto node = model.find_node(word)) {
    options.kept_nodes.push_back(*node);
  } else if (const Component* joint = joint_before_dot(word, model)) {
    options.kept_coordinates.push_back(read_coordinate(item, *joint, word.substr(word.rfind('.') + 1)));
  } else {
    std::vector<std::string> names;
    for (const Node& each : model.nodes())
      if (!each.internal) names.push_back(each.name);
    for (const std::string& name : model.names_in(Section::joints))
      for (const std::string& coordinate : names_of_coordinates(*model.components_of({Section::joints, name}).front()))
        names.push_back(name + "." + coordinate);
    item.fail(
        fmt::format("there is no node '{}', nor a joint with such a coordinate{}", word, did_you_mean(word, names)));
  }
}

}  // namespace

std::unique_ptr<Analysis> read_assembly(const YamlValue& entry, const Model& model) {
  entry.check_keys({"type", "keep"}, "the analysis 'assembly'");
  AssemblyOptions options;
  if (const auto keep = entry.find("keep"))
    for (const YamlValue& item : keep->items()) {
      read_kept(item, model, options);
      const auto twice = [&] { item.fail("stands in this list twice"); };
      const auto& nodes = options.kept_nodes;
      if (std::set<int>(nodes.begin(), nodes.end()).size() < nodes.size()) twice();
      std::set<std::pair<const Component*, std::size_t>> coordinates;
      for (const auto& [component, coordinate] : options.kept_coordinates)
        if (!coordinates.emplace(component, coordinate).second) twice();
    }
  return std::make_unique<AssemblyAnalysis>(std::move(options));
}

}  // namespace bielle::mechanism
