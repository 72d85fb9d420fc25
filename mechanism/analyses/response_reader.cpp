#include "mechanism/analyses/response_reader.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mechanism/measures/input_measure.hpp"
#include "mechanism/reading/names.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the name of an entry that is read as a measure.
template <class Kind>
std::string named_measure(const YamlValue& item, const Model& model, const char* of) {
  const std::string name = item.text();
  std::vector<std::string> names;
  for (const Member& member : model.members()) {
    if (member.entry.section == Section::measures && dynamic_cast<const Kind*>(member.component.get()))
      names.push_back(member.entry.name);
  }
  if (std::find(names.begin(), names.end(), name) == names.end())
    item.fail(fmt::format("there is no {} '{}'{}", of, name, did_you_mean(name, names)));
  return name;
}

struct Directed {
  int node;
  bool turning;
  Vector3 direction;
  std::string name;
};

/// Reads `{node: tip, direction: z}`. @param straight,turning  permitted values of `quantity`
Directed read_directed(const YamlValue& item, const Model& model, const char* straight, const char* turning,
                       const char* what) {
  item.check_keys({"node", "direction", "quantity"}, what);
  Directed result;
  result.node = node_named_by(item.at("node"), model);
  const std::string quantity =
      item.has("quantity") ? item.at("quantity").word({straight, turning}, "a quantity") : std::string(straight);
  result.turning = quantity == turning;
  const YamlValue direction = item.at("direction");
  std::string axis;
  if (direction.is_sequence()) {
    result.direction = direction.direction();
    axis = fmt::format("({:.3g}, {:.3g}, {:.3g})", result.direction.x(), result.direction.y(), result.direction.z());
  } else {
    axis = direction.word({"x", "y", "z"}, "a direction (x, y, z or a vector)");
    result.direction = Vector3::Unit(axis[0] - 'x');
  }
  result.name = fmt::format("{} {} of node '{}'", quantity, axis, model.node(result.node).name);
  return result;
}

}  // namespace

std::vector<ResponseInput> read_response_inputs(const YamlValue& entry, const Model& model) {
  std::vector<ResponseInput> inputs;
  for (const YamlValue& item : entry.at("inputs").items()) {
    if (item.is_map()) {
      const Directed directed = read_directed(item, model, "force", "moment", "an input: a force on a node");
      inputs.push_back({directed.name, directed.node, directed.turning, directed.direction});
    } else {
      inputs.push_back({named_measure<InputMeasure>(item, model, "input"), -1, false, Vector3::Zero()});
    }
  }
  if (inputs.empty()) entry.at("inputs").fail("expected at least one input");
  return inputs;
}

std::vector<ResponseOutput> read_response_outputs(const YamlValue& entry, const Model& model) {
  std::vector<ResponseOutput> outputs;
  for (const YamlValue& item : entry.at("outputs").items()) {
    if (item.is_map()) {
      const Directed directed = read_directed(item, model, "displacement", "rotation", "an output: what a node does");
      outputs.push_back({directed.name, directed.node, directed.turning, directed.direction});
    } else {
      outputs.push_back({named_measure<Measure>(item, model, "measure"), -1, false, Vector3::Zero()});
    }
  }
  if (outputs.empty()) entry.at("outputs").fail("expected at least one output");
  return outputs;
}

}  // namespace bielle::mechanism
