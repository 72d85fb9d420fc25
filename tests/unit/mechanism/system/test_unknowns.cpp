// Numbers and names of unknowns, the nodes that they move, and the pattern of the tangent.
#include <random>

#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/system/sparse_columns.hpp"
#include "mechanism/system/system.hpp"

using namespace bielle::mechanism;
using Catch::Matchers::Contains;

namespace test_unknowns {
namespace {

const char* const model_text = R"yaml(
nodes:
  a: {position: [0, 0, 0]}
  carried: {position: [0, 1, 0]}
  b: {position: [1, 0, 0], fixed: [y, rx, ry]}
  c: {position: [2, 0, 0]}
elements:
  body_a: {type: rigid_body, node: a, mass: 1, inertia: [1, 1, 1], also: [carried]}
  body_b: {type: point_mass, node: b, mass: 1}
  body_c: {type: rigid_body, node: c, mass: 1, inertia: [1, 1, 1]}
joints:
  pin: {type: spherical, nodes: [carried, b]}
  door: {type: hinge, nodes: [b, c], axis: [0, 0, 1]}
)yaml";

Model nodes_named(const std::vector<std::string>& names) {
  Model model;
  for (const std::string& name : names) {
    Node node;
    node.name = name;
    model.add_node(node);
  }
  return model;
}

}  // namespace

TEST_CASE("every unknown and equation goes by its node or component, and has units") {
  const MechanismFile file = read_mechanism_text(model_text, "unknowns.yaml");
  const System system(file.model);
  std::vector<std::string> unknowns, equations, units;
  for (int k = 0; k < system.size(); ++k) {
    unknowns.push_back(system.unknown_name(k));
    equations.push_back(system.equation_name(k));
    units.push_back(system.equation_units(k));
  }
  const auto six = [](const std::string& node) {
    std::vector<std::string> names;
    for (const char* kind : {"displacement ", "rotation "})
      for (const char* axis : {"x", "y", "z"}) names.push_back(kind + std::string(axis) + " of node '" + node + "'");
    return names;
  };
  std::vector<std::string> expected = six("a");
  for (const char* direction : {"displacement x", "displacement z", "rotation z"})
    expected.push_back(direction + std::string(" of node 'b'"));
  for (const std::string& name : six("c")) expected.push_back(name);
  for (const char* row : {"x", "y", "z"}) expected.push_back(row + std::string(" of joint 'pin'"));
  for (const char* row : {"x", "y", "z", "rx", "ry"}) expected.push_back(row + std::string(" of joint 'door'"));
  CHECK(unknowns == expected);
  CHECK(equations[0] == "force x at node 'a'");
  CHECK(equations[8] == "moment z at node 'b'");
  CHECK(equations[15] == "constraint x of joint 'pin'");
  CHECK(equations[22] == "constraint ry of joint 'door'");
  CHECK(units[0] == "N");
  CHECK(units[8] == "N m");
  CHECK(units[15] == "m");
  CHECK(units[22] == "rad");
}

TEST_CASE("rows are carried where one of the component's own is set aside") {
  const MechanismFile file = read_mechanism_text(model_text, "unknowns.yaml");
  System system(file.model);
  const auto carried = [&] {
    std::vector<std::string> names;
    for (std::size_t m = 0; m < system.slots().size(); ++m)
      if (system.slots()[m].multipliers > 0 && system.slots()[m].carried_axes)
        names.push_back(file.model.members()[m].component->name());
    return names;
  };
  CHECK(carried() == std::vector<std::string>{"pin", "door"});
  system.set_aside({});
  CHECK(carried().empty());
  system.set_aside({2});
  CHECK(carried() == std::vector<std::string>{"pin"});
  system.set_aside({3});
  CHECK(carried() == std::vector<std::string>{"door"});
}

TEST_CASE("rows and columns of constraints that are set aside are the identity's") {
  const MechanismFile file = read_mechanism_text(model_text, "unknowns.yaml");
  System system(file.model);
  system.set_aside({2, 5});
  const int first = system.size() - system.multipliers();
  State state = system.start(0);
  state.multiplier.setConstant(7);
  std::vector<double> values;
  system.tangent(state, file.model.environment, {2, 3, 4, 0, 5}, nullptr, values);
  MatrixX J = MatrixX::Zero(system.size(), system.size());
  system.pattern().for_each(
      [&](int place, int row, int column) { J(row, column) = values[static_cast<std::size_t>(place)]; });
  VectorX r(system.size());
  system.residual(state, file.model.environment, r);
  for (int k = 0; k < system.multipliers(); ++k) {
    const bool idle = k == 2 || k == 5;
    const VectorX unit = VectorX::Unit(system.size(), first + k);
    CAPTURE(k);
    CHECK((J.col(first + k) == unit) == idle);
    CHECK((J.row(first + k).transpose() == unit) == idle);
    CHECK((r[first + k] == 7) == idle);
  }
}

TEST_CASE("lines of carriers end at the node that is carried by none, in whatever order they stand") {
  Model model = nodes_named({"a", "b", "c", "d"});
  model.node(1).carrier = 2;
  model.node(2).carrier = 4;
  model.node(3).carrier = 1;
  const NodeKinematics kinematics(model);
  for (const int node : {1, 2, 3}) CHECK(kinematics.carry(node)->carrier == 4);
  CHECK(kinematics.carry(4) == nullptr);
  CHECK(kinematics.unknowns() == 6);
  for (int k = 0; k < 6; ++k) CHECK(kinematics.node_of(k) == 4);
}

TEST_CASE("carriers that run in a circle are told by a node of the circle") {
  Model model = nodes_named({"outside", "b", "c"});
  model.node(1).carrier = 2;
  model.node(2).carrier = 3;
  model.node(3).carrier = 2;
  CHECK_THROWS_WITH(NodeKinematics(model), Contains("node 'b' is carried by itself"));
}

TEST_CASE("a pattern gathered by columns is that of its entries") {
  std::mt19937 random(3);
  const int size = 40;
  std::uniform_int_distribution<int> index(0, size - 1);
  std::vector<std::pair<int, int>> entries;
  for (int k = 0; k < 300; ++k) {
    const int row = index(random), column = index(random) / 2;  // columns without entries, and with many
    entries.insert(entries.end(), {{row, column}, {row, column}});
  }
  const SparsePattern gathered = gather_columns(size, [&](const auto& act) {
    for (const auto& [row, column] : entries) act(row, column);
  });
  const SparsePattern sorted(size, entries);
  CHECK(gathered.size() == size);
  CHECK(gathered.column_start() == sorted.column_start());
  CHECK(gathered.row() == sorted.row());
}

}  // namespace test_unknowns
