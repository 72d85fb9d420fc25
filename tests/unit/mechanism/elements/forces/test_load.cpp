// Loads: closed forms. (Tangents and power: tests/laws.)
#include <catch2/catch.hpp>

#include "mechanism/elements/forces/load.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/model_text.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::model_from_text;
using Catch::Contains;

namespace {

// The node is turned by 90 degrees about z: its x axis is the inertial y axis.
VectorX force(const std::string& load, double time, double factor = 1) {
  const auto model = model_from_text(
      "nodes: {a: {position: [5, 6, 7], rotation_vector: [0, 0, pi/2]}}\nloads: {gas: {node: a, " + load + "}}");
  DenseModel dense(*model);
  dense.environment.load_factor = factor;
  State state = dense.start();
  state.time = time;
  return -dense.residual(state).tail<6>();
}

VectorX six(double a, double b, double c, double d, double e, double f) {
  return (VectorX(6) << a, b, c, d, e, f).finished();
}

}  // namespace

TEST_CASE("a dead load keeps its direction in space, its moment about the node is felt in the node's axes") {
  CHECK((force("force: ['2*t', 0, 0]", 3) - six(6, 0, 0, 0, 0, 0)).norm() < 1e-15);
  // The point is at 0.1 along the node's x (inertial y), and the force along inertial x: moment -0.6 about z.
  CHECK((force("force: ['2*t', 0, 0], at: [0.1, 0, 0]", 3) - six(6, 0, 0, 0, 0, -0.6)).norm() < 1e-15);
  CHECK((force("moment: [0, 4, 0]", 0) - six(0, 0, 0, 4, 0, 0)).norm() < 1e-15);
  CHECK((force("moment: [0, 4, 0]", 0, 0.25) - six(0, 0, 0, 1, 0, 0)).norm() < 1e-15);
}

TEST_CASE("a follower load turns with its node") {
  CHECK((force("force: ['2*t', 0, 0], follower: true", 3) - six(0, 6, 0, 0, 0, 0)).norm() < 1e-15);
  CHECK((force("force: [0, 2, 0], at: [0.1, 0, 0], follower: true", 3) - six(-2, 0, 0, 0, 0, 0.2)).norm() < 1e-15);
  CHECK((force("moment: [0, 4, 0], follower: true", 0) - six(0, 0, 0, 0, 4, 0)).norm() < 1e-15);
}

TEST_CASE("a load records its force and moment in inertial components, with the load factor") {
  const auto recorded = [](const std::string& load, double factor) {
    const auto model = model_from_text(
        "nodes: {a: {position: [5, 6, 7], rotation_vector: [0, 0, pi/2]}}\nloads: {gas: {node: a, " + load + "}}");
    const DenseModel dense(*model);
    const State state = dense.start();
    bielle::test::Environment environment;
    environment.load_factor = factor;
    Slots slots;
    slots.nodes = {1};
    VectorX out(6);
    model->members()[0].component->write_output({state, slots, environment}, out.data());
    return out;
  };
  const std::string both = "force: [1, 2, 3], moment: [4, 5, 6], at: [7, 8, 9]";
  CHECK((recorded(both, 1) - six(1, 2, 3, 4, 5, 6)).norm() < 1e-15);
  CHECK((recorded(both + ", follower: true", 0.5) - six(-1, 0.5, 1.5, -2.5, 2, 3)).norm() < 1e-15);
  CHECK((recorded("moment: [4, 5, 6]", 1) - six(0, 0, 0, 4, 5, 6)).norm() < 1e-15);
}

TEST_CASE("loads name the times at which their expressions break") {
  const auto model = model_from_text(
      "nodes: {a: {position: [0, 0, 0]}}\n"
      "loads: {gas: {node: a, force: ['ramp(t, 0.1, 0.2)', 0, 0], moment: [0, 't', 0]}}");
  std::vector<double> times;
  model->members()[0].component->add_break_points(times);
  REQUIRE(times.size() == 2);
  CHECK_THAT(times[0], Catch::WithinAbs(0.1, 1e-12));
  CHECK_THAT(times[1], Catch::WithinAbs(0.2, 1e-12));
}

TEST_CASE("a load without force or moment is refused") {
  CHECK_THROWS_WITH(force("follower: true", 0), Contains("loads.gas") && Contains("needs `force` or `moment`"));
  CHECK_THROWS_WITH(force("moment: [1, 0, 0], at: [1, 0, 0]", 0), Contains("loads.gas.at"));
  CHECK_THROWS_WITH(force("force: [1, 0]", 0), Contains("three components"));
}

TEST_CASE("components of a load may have units, which must fit") {
  CHECK((force("force: [2 kN, 0, 0], at: [100 mm, 0, 0]", 0) - six(2000, 0, 0, 0, 0, -200)).norm() < 1e-12);
  CHECK((force("moment: [0, 4 kN m, 0]", 0) - six(0, 0, 0, 4000, 0, 0)).norm() < 1e-12);
  CHECK_THROWS_WITH(force("force: [0, 2 N m, 0]", 0),
                    Contains("loads.gas.force[2]: expected a value in N, found one in 'N m'"));
}

TEST_CASE("forces and fields between nodes may have units, which must fit") {
  const auto residual = [](const std::string& keys) {
    const auto model = model_from_text(
        "nodes: {a: {position: [0, 0, 0]}, b: {position: [1, 0, 0]}}\nelements: {it: {nodes: [a, b], " + keys + "}}");
    const DenseModel dense(*model);
    State state = dense.start();
    state.nodes[2].x += Vector3(0.1, 0, 0);
    return VectorX(dense.residual(state).tail<12>());
  };
  const auto field = [](const std::string& k, const std::string& minus_k) {
    std::string rows;
    for (int i = 0; i < 12; ++i) {
      rows += "[";
      for (int j = 0; j < 12; ++j)
        rows += std::string(i % 6 == 0 && j % 6 == 0 ? (i == j ? k : minus_k) : "0") + (j < 11 ? ", " : "], ");
    }
    return "type: stiffness_field, stiffness: [" + rows + "]";
  };
  CHECK((residual("type: node_force, force: [1 kN, 0, 0], at: [20 mm, 0, 0]") -
         residual("type: node_force, force: [1000, 0, 0], at: [0.02, 0, 0]"))
            .norm() < 1e-12);
  CHECK((residual(field("2 kN/m", "-2 kN/m")) - residual(field("2000", "-2000"))).norm() < 1e-10);
  CHECK_THROWS_WITH(residual("type: node_force, moment: [1 kN, 0, 0]"),
                    Contains("moment[1]: expected a value in N m, found one in 'kN'"));
  CHECK_THROWS_WITH(residual(field("2 kg", "-2 kg")), Contains("expected a value in N/m or N") && Contains("'kg'"));
}
