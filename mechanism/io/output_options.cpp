#include "mechanism/io/output_options.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/model/mesh_fields.hpp"

namespace bielle::mechanism {
namespace {

/// Reads `only: {nodes: [pin], joints: []}`: in the named sections, nothing else is recorded.
void read_only(const YamlValue& only, Model& model) {
  only.check_keys({"nodes", "joints", "elements"}, "`only`");
  for (const Section section : {Section::nodes, Section::joints, Section::elements}) {
    const auto list = only.find(section_name(section));
    if (!list) continue;
    std::vector<std::string> available = model.names_in(section);
    for (const Node& node : model.nodes())
      if (section == Section::nodes && !node.internal && node.name != "ground") available.push_back(node.name);
    const std::set<std::string> known(available.begin(), available.end());
    std::set<std::string> wanted;
    for (const YamlValue& item : list->items()) {
      if (!known.contains(item.text())) item.word(available, fmt::format("one of the {}", section_name(section)));
      if (!wanted.insert(item.text()).second) item.fail("is named twice");
    }
    // An element in pieces represents them.
    for (const std::string& name : std::set<std::string>(wanted))
      for (const std::size_t m : model.members_of({section, name}))
        if (const Entry& results = model.members()[m].results; results.section == section) wanted.insert(results.name);
    for (const std::string& name : available)
      if (!wanted.contains(name)) model.leave_out({section, name});
  }
}

/// Calls act(component, name of the element, entry) for `key: {rod: entry}` and each component of the element (the
/// pieces of a body); the elements record.
template <class Act>
void for_each_element(const YamlValue& entries, const std::string& key, Model& model, Act&& act) {
  entries.check_keys(model.names_in(Section::elements), fmt::format("`{}`, which names elements", key));
  for (const auto& [element, entry] : entries.entries()) {
    if (!model.records({Section::elements, element})) entry.fail(fmt::format("`only` leaves out '{}'", element));
    for (Component* component : model.components_of({Section::elements, element})) act(*component, element, entry);
  }
}

/// Runs a function that may throw without the position in the file, and adds this position.
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
  for_each_element(
      fields, "fields", model, [](Component& component, const std::string& element, const YamlValue& names) {
        MeshFields* mesh = component.mesh_fields();
        if (!mesh)
          names.fail(
              fmt::format("a {} has no further fields: all that it knows is recorded already", component.type()));
        for (const YamlValue& name : names.items()) {
          const std::string field = name.word(mesh->field_names(), "a field of '" + element + "'");
          for (const OutputField& recorded : component.output_fields())
            if (recorded.name == field) name.fail("is asked for twice");
          at_place_of(name, [&] { mesh->record_field(field); });
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
  for_each_element(points, key, model, [&](Component& component, const std::string& element, const YamlValue& named) {
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
  for_each_element(peaks, "peaks", model, [](Component& component, const std::string& element, const YamlValue& names) {
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

OutputOptions read_output(const YamlValue& entry, double end, bool statics, Model& model) {
  entry.check_keys({"every", "times", "load_factors", "only", "fields", "stress_at", "strain_at", "peaks", "layout",
                    "checkpoint", "log"},
                   "`output`");
  OutputOptions output;
  if (entry.has("times")) {
    if (entry.has("every")) entry.at("every").fail("either `every` or `times`, not both");
    output.recording.times = read_times(entry.at("times"), end);
  }
  if (const auto factors = entry.find("load_factors"))
    output.recording.load_factors = read_load_factors(*factors, statics);
  if (entry.has("every")) output.recording.every = entry.at("every").integer();
  if (output.recording.every < 1) entry.at("every").fail("expected at least 1");
  if (entry.has("checkpoint")) {
    output.recording.checkpoint = entry.at("checkpoint").integer();
    if (output.recording.checkpoint < 1) entry.at("checkpoint").fail("expected at least 1 step");
  }
  if (entry.has("log")) output.log = entry.at("log").boolean();
  if (const auto layout = entry.find("layout")) {
    const std::string named = layout_name(ResultsLayout::named), stacked = layout_name(ResultsLayout::stacked);
    output.layout = layout->word({named, stacked}, "a layout of the results file") == named ? ResultsLayout::named
                                                                                            : ResultsLayout::stacked;
  }
  if (const auto only = entry.find("only")) read_only(*only, model);
  if (const auto fields = entry.find("fields")) read_fields(*fields, model);
  for (const char* field : {"stress", "strain"})
    if (const auto points = entry.find(std::string(field) + "_at")) read_points(*points, field, model);
  if (const auto peaks = entry.find("peaks")) read_peaks(*peaks, model);
  return output;
}

}  // namespace bielle::mechanism
