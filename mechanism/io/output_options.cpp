#include "mechanism/io/output_options.hpp"

#include <algorithm>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/model/mesh_fields.hpp"

namespace bielle::mechanism {
namespace {

const KeyTable& only_keys() {
  using namespace keys;
  static const KeyTable table{
      "`only`",
      "Parts of the model that are recorded: in the named sections these alone.",
      {{"nodes", list_of(name_of("node")), optional,
        "Nodes that are recorded, or parts whose nodes are; all without the key."},
       {"joints", list_of(name_of("joint")), optional, "Joints that are recorded, or parts; all without the key."},
       {"elements", list_of(name_of("element")), optional,
        "Elements that are recorded, or parts; all without the key."}}};
  return table;
}

/// Returns those names that belong to a part: "blade.tip", "blade.pump.rod".
std::vector<std::string> names_of_part(const std::string& part, const std::vector<std::string>& available) {
  std::vector<std::string> names;
  std::copy_if(available.begin(), available.end(), std::back_inserter(names),
               [&](const std::string& name) { return name.starts_with(part + "."); });
  return names;
}

/// Reads `only: {nodes: [pin], joints: []}`: in the named sections, nothing else is recorded.
void read_only(const YamlValue& only, Model& model) {
  for (const Section section : {Section::nodes, Section::joints, Section::elements}) {
    const auto list = only.find(section_name(section));
    if (!list) continue;
    std::vector<std::string> available = model.names_in(section);
    for (const Node& node : model.nodes())
      if (section == Section::nodes && !node.internal && node.name != "ground") available.push_back(node.name);
    const std::set<std::string> known(available.begin(), available.end());
    std::set<std::string> wanted;
    for (const YamlValue& item : list->items()) {
      const std::string name = item.text();
      std::vector<std::string> meant = known.contains(name) ? std::vector{name} : names_of_part(name, available);
      if (meant.empty()) item.word(available, fmt::format("one of the {}, or a part", section_name(section)));
      for (std::string& each : meant)
        if (!wanted.insert(std::move(each)).second) item.fail("is named twice");
    }
    // The pieces of an element record under its name.
    for (const std::string& name : std::set<std::string>(wanted))
      for (const std::size_t m : model.members_of({section, name}))
        if (const Entry& results = model.members()[m].results; results.section == section) wanted.insert(results.name);
    for (const std::string& name : available)
      if (!wanted.contains(name)) model.leave_out({section, name});
  }
}

/// Calls act(component, name of the element, entry) for `key: {rod: entry}` and each component of the element: a body
/// in pieces has several.
template <class Act>
void for_each_element(const YamlValue& entries, Model& model, Act&& act) {
  const std::vector<std::string> names = model.names_in(Section::elements);
  for (const auto& [element, entry] : entries.entries()) {
    if (std::find(names.begin(), names.end(), element) == names.end())
      entry.fail(fmt::format("there is no element '{}'{}", element, did_you_mean(element, names)));
    if (!model.records({Section::elements, element})) entry.fail(fmt::format("`only` leaves out '{}'", element));
    for (Component* component : model.components_of({Section::elements, element})) act(*component, element, entry);
  }
}

/// Runs a function, and adds the position in the file to its exceptions.
template <class Act>
void at_place_of(const YamlValue& value, Act&& act) {
  try {
    act();
  } catch (const InputError& error) {
    value.fail(error.what());
  }
}

/// Reads `fields: {rod: [displacement, von_mises]}`: outputs of elements in addition to the usual ones.
void read_fields(const YamlValue& fields, Model& model) {
  for_each_element(fields, model, [](Component& component, const std::string& element, const YamlValue& names) {
    MeshFields* mesh = component.mesh_fields();
    if (!mesh)
      names.fail(fmt::format("a {} has no further fields: all that it knows is recorded already", component.type()));
    for (const YamlValue& name : names.items()) {
      const std::string field = name.word(mesh->field_names(), "a field of '" + element + "'");
      for (const OutputField& recorded : component.output_fields())
        if (recorded.name == field) name.fail("is asked for twice");
      at_place_of(name, [&] { mesh->record_field(field); });
    }
  });
}

/// Reads `quantities: {rod: [gauges]}`: numbers that the file of another program recovers.
void read_quantities(const YamlValue& quantities, Model& model) {
  for_each_element(quantities, model, [](Component& component, const std::string& /*element*/, const YamlValue& names) {
    MeshFields* mesh = component.mesh_fields();
    if (!mesh) names.fail(fmt::format("a {} has no quantities; `quantities` is for superelements", component.type()));
    if (names.size() == 0) names.fail("expected one or more quantities of the superelement's file");
    for (const YamlValue& name : names.items()) {
      for (const OutputField& recorded : component.output_fields())
        if (recorded.name == name.text()) name.fail(fmt::format("'{}' is recorded already", name.text()));
      at_place_of(name, [&] { mesh->record_quantity(name.text()); });
    }
  });
}

/// Reads a point of a mesh, `[x, y, z]`, or the number of one of its nodes.
MeshPlace read_mesh_place(const YamlValue& value) {
  MeshPlace place;
  if (value.is_sequence())
    place.point = value.vector3();
  else
    place.node = value.integer();
  return place;
}

/// Reads `stress_at: {rod: {root: [x, y, z]}}`: a field of stress or strain at single points of an element's mesh.
void read_points(const YamlValue& points, const std::string& field, Model& model) {
  const std::string key = field + "_at";
  for_each_element(points, model, [&](Component& component, const std::string& element, const YamlValue& named) {
    if (model.components_of({Section::elements, element}).size() > 1)
      named.fail(fmt::format("'{}' is in pieces; ask for `fields` of its stress, or for `peaks`", element));
    MeshFields* mesh = component.mesh_fields();
    if (!mesh)
      named.fail(fmt::format("a {} has no mesh with points; `{}` is for superelements", component.type(), key));
    for (const auto& [name, place] : named.entries()) {
      if (name.empty() || name.find('/') != std::string::npos) place.fail("expected a name without '/'");
      const MeshPlace where = read_mesh_place(place);
      at_place_of(place, [&] { mesh->record_at(field, name, where); });
    }
  });
}

/// Reads `peaks: {rod: [von_mises, principal_stress]}`: largest values over all steps.
void read_peaks(const YamlValue& peaks, Model& model) {
  for_each_element(peaks, model, [](Component& component, const std::string& element, const YamlValue& names) {
    MeshFields* mesh = component.mesh_fields();
    if (!mesh)
      names.fail(fmt::format("a {} has no stresses of a mesh; `peaks` is for superelements", component.type()));
    const std::vector<std::string> available = mesh->peak_names();
    std::vector<std::string> wanted;
    for (const YamlValue& name : names.items()) {
      wanted.push_back(name.word(available, "a peak of '" + element + "'"));
      if (std::count(wanted.begin(), wanted.end(), wanted.back()) > 1) name.fail("is asked for twice");
    }
    if (wanted.empty()) names.fail(fmt::format("expected one or more of {}", fmt::join(available, ", ")));
    at_place_of(names, [&] { mesh->record_peaks(wanted); });
  });
}

/// Reads the times to record, ascending. @param end  end of the last dynamic analysis [s]
std::vector<double> read_times(const YamlValue& entry, double end) {
  std::vector<double> times;
  for (const YamlValue& item : entry.items()) {
    const double time = item.number();
    if (!(time >= 0 && time <= end * (1 + 1e-12)))
      item.fail(fmt::format("the motions run from t = 0 to {:.6g} s", end));
    if (!times.empty() && time <= times.back()) item.fail("expected times in ascending order, each once");
    times.push_back(time);
  }
  if (times.empty()) entry.fail("expected a list of times [s]");
  return times;
}

std::vector<double> read_load_factors(const YamlValue& entry, bool statics) {
  if (!statics) entry.fail("this model has no static analysis");
  std::vector<double> factors;
  for (const YamlValue& item : entry.items()) {
    factors.push_back(item.number());
    if (factors.size() > 1 && factors.back() <= factors[factors.size() - 2])
      item.fail("expected load factors in ascending order, each once");
  }
  if (factors.empty()) entry.fail("expected a list of load factors");
  return factors;
}

}  // namespace

const KeyTable& output_keys() {
  using namespace keys;
  const KeyForm places = entries("element", {entries("point", {vector3("m").as_point(), integer().non_negative()})});
  static const KeyTable table{
      "`output`",
      "Rows and contents of the results file.",
      {{"every", integer().at_least(1), otherwise("1"),
        "Steps between recorded rows; the first and the last are always recorded."},
       {"times", list_of(number("s")).items_at_least(1), optional,
        "Ascending times that are recorded exactly, besides the start of each dynamic analysis, in place of steps."},
       {"load_factors", list_of(number()).items_at_least(1), optional,
        "Ascending load factors that static analyses meet exactly, and record alone."},
       {"only", nested(only_keys), optional, "Nodes, joints and elements that are recorded; all without the key."},
       {"fields",
        entries("element",
                {list_of(word({"displacement", "stress", "strain", "von_mises", "principal_stress", "principal_strain"},
                              "a field"))}),
        optional, "Fields of superelements that are recorded at the nodes of their mesh."},
       {"stress_at", places, optional,
        "Points of superelements at which the stress is recorded: each in the mesh's axes, or the number of a node "
        "from "
        "0."},
       {"strain_at", places, optional,
        "Points of superelements at which the strain is recorded: each in the mesh's axes, or the number of a node "
        "from "
        "0."},
       {"quantities", entries("element", {list_of(text()).items_at_least(1)}), optional,
        "Quantities of superelements that the file of another program recovers, such as the stress of gauges."},
       {"peaks", entries("element", {list_of(word({"von_mises", "principal_stress"}, "a peak")).items_at_least(1)}),
        optional, "Stresses of superelements of which the largest values over all accepted steps are recorded."},
       {"layout",
        word({layout_name(ResultsLayout::named), layout_name(ResultsLayout::stacked)}, "a layout of the results file"),
        computed("`stacked` for large models"),
        "Layout of the results file: datasets of each node, joint and element (`named`), or one dataset for each "
        "quantity of similar ones (`stacked`)."},
       {"checkpoint", integer().at_least(1), optional,
        "Steps between points from which the run can be continued; without the key there is one where the run is "
        "interrupted, fails or ends."},
       {"log", boolean(), otherwise("false"),
        "Whether a table of all attempted steps is written next to the results."}}};
  return table;
}

OutputOptions read_output(const YamlValue& section, double end, bool statics, Model& model) {
  const YamlValue entry = section.keyed(output_keys());
  OutputOptions output;
  if (entry.has("times")) {
    if (entry.has("every")) entry.at("every").fail("either `every` or `times`, not both");
    output.recording.times = read_times(entry.at("times"), end);
  }
  if (const auto factors = entry.find("load_factors"))
    output.recording.load_factors = read_load_factors(*factors, statics);
  output.recording.every = entry.at("every").integer();
  if (const auto checkpoint = entry.find("checkpoint")) output.recording.checkpoint = checkpoint->integer();
  output.log = entry.at("log").boolean();
  if (const auto layout = entry.find("layout"))
    output.layout = layout->word() == layout_name(ResultsLayout::named) ? ResultsLayout::named : ResultsLayout::stacked;
  if (const auto only = entry.find("only")) read_only(*only, model);
  if (const auto fields = entry.find("fields")) read_fields(*fields, model);
  for (const char* field : {"stress", "strain"})
    if (const auto points = entry.find(std::string(field) + "_at")) read_points(*points, field, model);
  if (const auto quantities = entry.find("quantities")) read_quantities(*quantities, model);
  if (const auto peaks = entry.find("peaks")) read_peaks(*peaks, model);
  return output;
}

}  // namespace bielle::mechanism
