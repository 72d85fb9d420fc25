#include "mechanism/io/output_options.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

/// `only: {nodes: [pin], joints: []}`: of the sections that are named, nothing else is recorded.
void read_only(const YamlValue& only, Model& model) {
  const std::vector<std::string> sections = {"nodes", "joints", "elements"};
  only.check_keys(sections, "`only`");
  for (const auto& [section, list] : only.entries()) {
    std::vector<std::string> available;
    if (section == "nodes") {
      for (const Node& node : model.nodes())
        if (!node.internal && node.name != "ground") available.push_back(node.name);
    } else {
      available = model.names_in(section);
    }
    std::set<std::string> wanted;
    for (const YamlValue& item : list.items())
      if (!wanted.insert(item.word(available, "one of the " + section)).second) item.fail("is named twice");
    for (const std::string& name : available)
      if (!wanted.contains(name)) model.leave_out(section + "/" + name);
  }
}

/// `fields: {rod: [displacement, von_mises]}`: what elements record beside their own outputs.
void read_fields(const YamlValue& fields, Model& model) {
  fields.check_keys(model.names_in("elements"), "`fields`, which names elements");
  for (const auto& [element, names] : fields.entries()) {
    if (!model.records("elements/" + element)) names.fail(fmt::format("`only` leaves out '{}'", element));
    Component& component = *model.components_in("elements/" + element).front();
    const std::vector<std::string> available = component.optional_fields();
    if (available.empty())
      names.fail(fmt::format("a {} has no further fields: all that it knows is recorded already", component.type()));
    for (const YamlValue& name : names.items()) {
      const std::string field = name.word(available, "a field of '" + element + "'");
      for (const OutputField& recorded : component.output_fields())
        if (recorded.name == field) name.fail("is asked for twice");
      try {
        component.record_field(field);
      } catch (const InputError& error) {
        name.fail(error.what());
      }
    }
  }
}

/// Times to record, ascending. @param end  of the last dynamic analysis [s]
std::vector<double> read_times(const YamlValue& entry, double end) {
  std::vector<double> times;
  for (const YamlValue& item : entry.items()) {
    const double time = item.number();
    if (!(time >= 0 && time <= end * (1 + 1e-12)))
      item.fail(fmt::format("the dynamic analyses run from t = 0 to {:.6g} s", end));
    if (!times.empty() && time <= times.back()) item.fail("expected times in ascending order, each once");
    times.push_back(time);
  }
  if (times.empty()) entry.fail("expected a list of times [s]");
  return times;
}

}  // namespace

OutputOptions read_output(const YamlValue& entry, double end, Model& model) {
  entry.check_keys({"every", "times", "only", "fields", "checkpoint", "log"}, "`output`");
  OutputOptions output;
  if (entry.has("times")) {
    if (entry.has("every")) entry.at("every").fail("either `every` or `times`, not both");
    output.recording.times = read_times(entry.at("times"), end);
  }
  if (entry.has("every")) output.recording.every = entry.at("every").integer();
  if (output.recording.every < 1) entry.at("every").fail("expected at least 1");
  if (entry.has("checkpoint")) {
    output.recording.checkpoint = entry.at("checkpoint").integer();
    if (output.recording.checkpoint < 1) entry.at("checkpoint").fail("expected at least 1 step");
  }
  if (entry.has("log")) output.log = entry.at("log").boolean();
  if (const auto only = entry.find("only")) read_only(*only, model);
  if (const auto fields = entry.find("fields")) read_fields(*fields, model);
  return output;
}

}  // namespace bielle::mechanism
