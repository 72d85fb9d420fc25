#include "reduce/body_file/matrix_body.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "reduce/body_file/body_axes.hpp"
#include "reduce/body_file/body_interfaces.hpp"
#include "reduce/body_file/body_points.hpp"
#include "reduce/body_file/requested_modes.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::reduce {

namespace {

ForeignMatrices read_files(const YamlValue& value) {
  ForeignMatrices files;
  if (!value.is_map()) {
    files.path = value.file_path();
    return files;
  }
  files.path = value.at("file").file_path();
  if (const auto mass = value.find("mass")) files.mass = mass->file_path();
  if (const auto nodes = value.find("nodes")) files.nodes = nodes->file_path();
  if (const auto unknowns = value.find("unknowns")) files.unknowns = unknowns->file_path();
  if (const auto format = value.find("format")) files.format = format->text();
  if (const auto units = value.find("units")) files.units = units->text();
  if (const auto names = value.find("names"))
    for (const auto& [matrix, name] : names->entries()) files.names[matrix] = name.text();
  if (const auto quantities = value.find("quantities"))
    for (const auto& [name, quantity] : quantities->entries()) {
      check_name(name, quantity);
      files.quantities[name] = {quantity.at("matrix").text(), quantity.at("kind").word()};
    }
  return files;
}

/// Reads the names of rows: a list for all of them, or a map to the numbers of some.
QuantityRows read_rows(const YamlValue& value) {
  QuantityRows rows;
  rows.subject = value.path();
  std::set<std::string> names;
  const auto add = [&](const std::string& name, const YamlValue& at) {
    check_name(name, at);
    if (!names.insert(name).second) at.fail(fmt::format("there are two rows '{}'", name));
  };
  if (value.is_sequence())
    for (const YamlValue& item : value.items()) {
      add(item.text(), item);
      rows.all.push_back(item.text());
    }
  else
    for (const auto& [name, number] : value.entries()) {
      add(name, number);
      rows.chosen.emplace_back(name, number.integer());
    }
  if (names.empty()) value.fail("expected the name of at least one row");
  return rows;
}

std::map<std::string, QuantityRows> read_quantity_rows(const YamlValue& matrices) {
  std::map<std::string, QuantityRows> result;
  const auto quantities = matrices.is_map() ? matrices.find("quantities") : std::nullopt;
  if (quantities)
    for (const auto& [name, quantity] : quantities->entries())
      if (const auto rows = quantity.find("rows")) result[name] = read_rows(*rows);
  return result;
}

std::vector<double> read_weights(const YamlValue& value, std::size_t nodes) {
  std::vector<double> weights;
  for (const YamlValue& item : value.items()) weights.push_back(item.number());
  if (weights.size() != nodes)
    value.fail(fmt::format("expected one weight for each of the {} nodes, found {}", nodes, weights.size()));
  return weights;
}

NodeInterface read_node_interface(const std::string& name, const YamlValue& value) {
  check_name(name, value);
  NodeInterface interface;
  interface.name = name;
  interface.subject = value.path();
  for (const char* key : {"from", "surface"})
    if (value.has(key)) value.at(key).fail("matrices have nodes, no surfaces: expected `node` or `nodes`");
  if (value.has("node") == value.has("nodes"))
    value.fail("expected either `node`, a node of the file, or `nodes`, a list of them");
  if (const auto node = value.find("node")) {
    interface.nodes = {node->integer()};
    for (const char* key : {"position", "weights", "tie"})
      if (value.has(key)) value.at(key).fail("a single node is where it is: remove this key, or tie `nodes`");
  } else {
    const YamlValue nodes = value.at("nodes");
    for (const YamlValue& item : nodes.items()) interface.nodes.push_back(item.integer());
    if (interface.nodes.empty()) nodes.fail("expected at least one node");
    interface.tie = read_tie(value.at("tie"));
    if (interface.tie == Tie::free)
      value.at("tie").fail("nodes are free as interfaces of their own, with `node`; expected rigid or average");
    if (const auto position = value.find("position")) interface.position = position->vector3();
    if (const auto weights = value.find("weights")) {
      if (interface.tie != Tie::average) weights->fail("weights belong to 'tie: average'");
      interface.weights = read_weights(*weights, interface.nodes.size());
    }
  }
  const auto axes = value.find("axes"), rotation = value.find("rotation_vector");
  if (axes && rotation) value.fail("expected either axes or rotation_vector, not both");
  if (axes) interface.rotation = read_axes(*axes);
  if (rotation) interface.rotation = read_rotation_vector(*rotation);
  if (const auto directions = value.find("directions")) interface.kept = read_directions(*directions);
  return interface;
}

NodePoint read_node_point(const std::string& name, const YamlValue& value) {
  check_name(name, value);
  NodePoint point;
  point.name = name;
  point.subject = value.path();
  if (value.has("node") == value.has("at"))
    value.fail("expected either `node`, a node of the file, or `at`, a place among its nodes");
  for (const char* key : {"group", "position"})
    if (value.has(key)) value.at(key).fail("it belongs to a geometry: matrices have nodes alone; remove this key");
  point.residual = read_residual(value.at("residual"));
  if (const auto node = value.find("node"))
    point.node = node->integer();
  else
    point.place = value.at("at").vector3();
  return point;
}

/// Refuses keys that only a geometry has.
void refuse_other_keys(const YamlValue& root) {
  for (const char* key : {"geometry", "length_unit", "volume", "volumes", "glue", "mesh", "materials", "mass_unit",
                          "integration", "regions", "loads", "masses", "lumped", "recovery", "pieces"})
    if (root.has(key))
      root.at(key).fail(
          "it belongs to a geometry, and this body is given by `matrices`: remove this key. Units of the matrices are "
          "`matrices: {file: .., units: mm-t-s}`");
}

}  // namespace

const KeyTable& quantity_keys() {
  using namespace keys;
  static const KeyTable table{
      "a recovered quantity",
      "Numbers that a matrix of the file computes from its unknowns, an output transformation matrix.",
      {{"matrix", text(), required, "Name of the matrix in the file: `MES1`, `OTM1`."},
       {"kind",
        word({"stress", "strain", "force", "moment", "displacement", "rotation", "number"}, "a kind of quantity"),
        required, "Kind of the numbers, by which they are converted to SI units."},
       {"rows",
        {list_of(text()), entries("row", {integer().at_least(1)})},
        computed("names by a table of the file, or `row_1`, `row_2` .."),
        "Names of all rows, or a map from a name to the number of a row, which chooses some."}}};
  return table;
}

const KeyTable& matrices_keys() {
  using namespace keys;
  static const KeyTable table{
      "the matrices",
      "Files of another program with stiffness and mass; tools/guide/exchange.md lists the formats.",
      {{"file", file("matrices"), required, "File of both matrices, or of the stiffness."},
       {"mass", file("matrices"), optional, "Another file with the mass, for formats with one matrix in each."},
       {"nodes", file("deck or table"), optional,
        "Another file with the numbers and positions of the nodes: a deck, or a table with the columns node, x, y, z."},
       {"unknowns", file("table"), optional,
        "Another file with the order of the unknowns, for formats that have rows alone: a table with the columns node "
        "and "
        "component."},
       {"units", text(), computed("SI, or those that the file declares"),
        "Units of length, mass and time of the numbers: `mm-t-s` for millimetres, tonnes and seconds (N, MPa)."},
       {"names", entries("matrix", {text()}), optional,
        "Names of the matrices in the file, if they are not the usual ones: `{stiffness: KAAX, mass: MAAX}`."},
       {"quantities", entries("quantity", {nested(quantity_keys)}), optional,
        "Further numbers that matrices of the file recover, such as the stress of gauges: a mechanism records them on "
        "request."},
       {"format", text(), computed("known by the file"), "Name of the format, if the ending is not enough."}}};
  return table;
}

MatrixBody read_matrix_body(const YamlValue& root) {
  refuse_other_keys(root);
  MatrixBody body;
  body.files = read_files(root.at("matrices"));
  body.files.in_body_file = true;
  MatrixOptions& options = body.options;
  options.name = root.at("body").text();
  options.input_text = root.source_text();
  if (const auto interfaces = root.find("interfaces")) {
    for (const auto& [name, value] : interfaces->entries())
      options.interfaces.push_back(read_node_interface(name, value));
    if (options.interfaces.empty()) interfaces->fail("expected at least one, or leave the key out");
    for (const NodeInterface& interface : options.interfaces)
      body.files.interfaces.insert(body.files.interfaces.end(), interface.nodes.begin(), interface.nodes.end());
  }
  if (const auto modes = root.find("modes")) {
    const RequestedModes requested = read_modes(*modes);
    if (requested.proven) modes->at("proof").fail("modes of matrices are not counted: remove this key");
    options.modes = requested.request;
  }
  if (const auto damping = root.find("damping")) {
    const RequestedDamping requested = read_damping(*damping);
    options.damping_ratios = requested.ratios;
    options.rayleigh = requested.rayleigh;
  }
  if (const auto points = root.find("points"))
    for (const auto& [name, value] : points->entries()) options.points.push_back(read_node_point(name, value));
  options.quantity_rows = read_quantity_rows(root.at("matrices"));
  options.inertia_relief = root.at("inertia_relief").boolean();
  if (const auto spin = root.find("spin")) options.spin = spin->vector3();
  return body;
}

}  // namespace bielle::reduce
