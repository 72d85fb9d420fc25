// `assembly`: positions and velocities are made consistent, and recorded.
//
// `keep`: nodes that keep their positions, and coordinates of joints that keep their values:
//     keep: [base, crank.angle, {joint: 'left arm', coordinate: angle}]
// A word is the name of a node; otherwise it is the name of a joint, followed by a dot and the coordinate. A map may
// omit the coordinate if the joint has only one.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/analyses/coordinate_reader.hpp"
#include "mechanism/analyses/summary_text.hpp"
#include "reduce/common/error.hpp"

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

void read_kept(const YamlValue& item, const Model& model, AssemblyOptions& options) {
  if (item.is_map()) {
    options.kept_coordinates.push_back(read_coordinate_map(item, model));
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

const KeyTable& assembly_keys() {
  using namespace keys;
  static const KeyTable table{
      "the analysis 'assembly'",
      "Positions and velocities are made consistent, and recorded.",
      {analysis_type_key("assembly"),
       {"keep",
        list_of(KeyForms{name_of("node"), name_of("joint"), state_formula("any", {}), nested(kept_coordinate_keys)}),
        optional,
        "Nodes that stay exactly in place, and coordinates of joints, `joint.coordinate`, that keep their values."}}};
  return table;
}

std::unique_ptr<Analysis> read_assembly(const YamlValue& entry, const Model& model) {
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
