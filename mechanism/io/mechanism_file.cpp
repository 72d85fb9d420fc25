#include "mechanism/io/mechanism_file.hpp"

#include <set>

#include <fmt/format.h>

#include "mechanism/analyses/analysis_table.hpp"
#include "mechanism/elements/forces/support.hpp"
#include "mechanism/elements/superelement/body_points.hpp"
#include "mechanism/hydraulics/reading/circuit_reader.hpp"
#include "mechanism/io/component_table.hpp"
#include "mechanism/io/idle_joints.hpp"
#include "mechanism/io/implausible_lengths.hpp"
#include "mechanism/io/mechanism_keys.hpp"
#include "mechanism/io/node_reader.hpp"
#include "mechanism/io/settle_idle_rotations.hpp"
#include "mechanism/joints/actions/event_reader.hpp"
#include "mechanism/language/cases.hpp"
#include "mechanism/language/expand_model.hpp"
#include "mechanism/measures/input_measure.hpp"
#include "mechanism/measures/read_measure.hpp"
#include "mechanism/reading/names.hpp"
#include "reduce/common/files/file_checks.hpp"
#include "reduce/common/input/plausible.hpp"
#include "reduce/common/input/yaml_node.hpp"
#include "reduce/common/input/yaml_writer.hpp"

namespace bielle::mechanism {
namespace {

constexpr PlausibleRange plausible_gravity{0, 300, "Lengths are in metres: on the earth 9.81 m/s^2"};

/// Returns the entries of a section, with names under which results can be stored.
std::vector<std::pair<std::string, YamlValue>> named_entries(const YamlValue& section) {
  auto entries = section.entries();
  for (const auto& [name, entry] : entries) check_name(name, entry);
  return entries;
}

/// Returns the paths of the shapes by which nodes and elements are drawn: "elements.arm.shape".
std::set<std::string> paths_of_shapes(const YamlValue& root) {
  std::set<std::string> paths;
  for (const char* section : {"nodes", "elements"})
    if (const auto entries = root.find(section))
      for (const auto& [name, entry] : entries->entries())
        if (const auto shape = entry.find("shape")) paths.insert(shape->path());
  return paths;
}

/// Returns the values on which the motion of the model depends. Shapes are excluded, because a run may continue with
/// other ones.
std::vector<std::pair<std::string, std::string>> digest_of_model(const YamlValue& root) {
  auto digest = root.digest({"mechanism", "parameters", "analysis", "output"});
  const std::set<std::string> shapes = paths_of_shapes(root);
  const auto is_of_shape = [&](const std::pair<std::string, std::string>& value) {
    const std::string key = ".shape";
    const std::string& path = value.first;
    for (std::size_t at = path.find(key); at != std::string::npos; at = path.find(key, at + 1))
      if (shapes.contains(path.substr(0, at + key.size()))) return true;
    return false;
  };
  if (!shapes.empty()) std::erase_if(digest, is_of_shape);
  return digest;
}

MechanismFile read_mechanism(const std::string& text, const std::string& name, const ModelOptions& options) {
  const ExpandedModel expanded = expand_model(parse_yaml(text, name), name, mechanism_file_keys(), options);
  YamlValue whole = YamlValue::of_tree(expanded.root, text, name);
  whole.set_parameters(expanded.parameters);
  const YamlValue root = whole.keyed(mechanism_file_keys());
  MechanismFile file;
  file.text = expanded.is_changed ? write_yaml(*expanded.root) : text;
  file.maker = [text, name, options](const std::string& parameter, double value) {
    ModelOptions others = options;
    others.overrides[parameter] = fmt::format("{}", value);
    return read_mechanism(text, name, others).model;
  };
  file.model.parameters = root.parameters();
  if (root.has("mechanism")) file.model.title = root.at("mechanism").text();
  if (const auto gravity = root.find("gravity")) {
    file.model.environment.gravity = gravity->vector3();
    constexpr double most = 1e60;  // largest gravity with finite weights
    if (!(file.model.environment.gravity.cwiseAbs().maxCoeff() < most))
      gravity->fail("expected accelerations in m/s^2; no force can be computed with these");
    warn_outside(*gravity, file.model.environment.gravity.norm(), plausible_gravity);
  }

  if (const auto nodes = root.find("nodes")) read_nodes(named_entries(*nodes), file.model);
  if (const auto points = root.find("points")) read_body_points(*points, root.find("elements"), file.model);
  if (const auto hydraulics = root.find("hydraulics")) read_hydraulics(*hydraulics, file.model);
  for (const Section section : {Section::elements, Section::joints, Section::drives, Section::loads, Section::states}) {
    const auto entries = root.find(section_name(section));
    if (!entries) continue;
    for (const auto& [entry_name, entry] : named_entries(*entries))
      read_component(section, entry_name, entry, file.model);
  }
  if (const auto measures = root.find("measures"))
    for (const auto& [entry_name, entry] : named_entries(*measures)) read_measure(entry_name, entry, file.model);
  if (const auto inputs = root.find("inputs"))
    for (const auto& [entry_name, entry] : named_entries(*inputs)) read_input(entry_name, entry, file.model);
  if (const auto events = root.find("events"))
    for (const auto& [entry_name, entry] : named_entries(*events)) read_event(entry_name, entry, file.model);
  file.model.connect();
  settle_idle_rotations(file.model);
  add_supports(file.model);
  warn_of_lengths(file.model, root);
  warn_of_idle_joints(file.model, root);
  if (file.model.members().empty()) root.fail("the mechanism has no elements, joints or loads");

  if (const auto analyses = root.find("analysis"))
    for (const YamlValue& entry : analyses->items()) file.analyses.push_back(read_analysis(entry, file.model));
  for (const auto& analysis : file.analyses) analysis->set_maker(file.maker);
  double end = 0;
  bool statics = false;
  for (const auto& analysis : file.analyses) {
    end += analysis->duration();
    statics = statics || analysis->type() == "static";
  }
  if (const auto output = root.find("output")) file.output = read_output(*output, end, statics, file.model);
  file.warnings = root.warnings();
  file.model.source = digest_of_model(root);
  return file;
}

}  // namespace

MechanismFile read_mechanism_file(const std::string& path, const std::map<std::string, std::string>& overrides,
                                  const std::string& chosen_case) {
  MechanismFile file = read_mechanism(read_input_text(path), path, {overrides, chosen_case});
  file.path = path;
  return file;
}

MechanismFile read_mechanism_text(const std::string& text, const std::string& name,
                                  const std::map<std::string, std::string>& overrides) {
  return read_mechanism(text, name, {overrides, {}});
}

std::vector<std::string> read_case_names(const std::string& path) {
  return case_names(parse_yaml(read_input_text(path), path), path);
}

}  // namespace bielle::mechanism
