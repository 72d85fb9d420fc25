#include "mechanism/analyses/response_reader.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mechanism/analyses/direction_reader.hpp"
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

const KeyTable& node_input_keys() {
  using namespace keys;
  static const KeyTable table{"an input: a force on a node",
                              "A force or moment on a node.",
                              {{"node", name_of("node"), required, "The node on which it acts."},
                               {"direction", direction_forms(), required, "Inertial direction: x, y, z or a vector."},
                               {"quantity", word({"force", "moment"}, "a quantity"), otherwise("force"),
                                "A `force` [N], or a `moment` [N m]."}}};
  return table;
}

const KeyTable& node_output_keys() {
  using namespace keys;
  static const KeyTable table{"an output: what a node does",
                              "A small motion of a node.",
                              {{"node", name_of("node"), required, "The node that moves."},
                               {"direction", direction_forms(), required, "Inertial direction: x, y, z or a vector."},
                               {"quantity", word({"displacement", "rotation"}, "a quantity"), otherwise("displacement"),
                                "The `displacement` [m], or the `rotation` [rad]."}}};
  return table;
}

struct Directed {
  int node;
  bool turning;
  Vector3 direction;
  std::string name;
};

/// Reads `{node: tip, direction: z}`.
Directed read_directed(const YamlValue& item, const Model& model) {
  Directed result;
  result.node = node_named_by(item.at("node"), model);
  const std::string quantity = item.at("quantity").word();
  result.turning = quantity == "moment" || quantity == "rotation";
  const YamlValue direction = item.at("direction");
  result.direction = read_direction(direction);
  const Vector3& d = result.direction;
  const std::string axis =
      direction.is_sequence() ? fmt::format("({:.3g}, {:.3g}, {:.3g})", d.x(), d.y(), d.z()) : direction.text();
  result.name = fmt::format("{} {} of node '{}'", quantity, axis, model.node(result.node).name);
  return result;
}

}  // namespace

std::vector<Key> response_keys() {
  using namespace keys;
  return {{"inputs", list_of(KeyForms{name_of("input"), nested(node_input_keys)}).items_at_least(1), required,
           "Inputs of the model, and forces or moments on nodes."},
          {"outputs", list_of(KeyForms{name_of("measure"), nested(node_output_keys)}).items_at_least(1), required,
           "Measures of the model, and motions of nodes."}};
}

std::vector<ResponseInput> read_response_inputs(const YamlValue& entry, const Model& model) {
  std::vector<ResponseInput> inputs;
  for (const YamlValue& item : entry.at("inputs").items()) {
    if (item.is_map()) {
      const Directed directed = read_directed(item, model);
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
      const Directed directed = read_directed(item, model);
      outputs.push_back({directed.name, directed.node, directed.turning, directed.direction});
    } else {
      outputs.push_back({named_measure<Measure>(item, model, "measure"), -1, false, Vector3::Zero()});
    }
  }
  if (outputs.empty()) entry.at("outputs").fail("expected at least one output");
  return outputs;
}

}  // namespace bielle::mechanism
