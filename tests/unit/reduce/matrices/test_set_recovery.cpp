// Compares quantities, stress, cells and inertia from matrices of other programs with the reduction of the mesh.
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/matrices/set_algebra.hpp"
#include "reduce/matrices/set_recovery.hpp"
#include "reduce/matrices/superelement_set.hpp"
#include "tests/unit/reduce/matrices/matrix_bodies.hpp"
#include "tests/unit/reduce/matrices/verified.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Catch::Contains;

namespace {

/// Returns a reduced body of a mesh with its stress at all nodes, and a quantity of three of its rows.
Superelement stressed_body() {
  ReductionOptions options = test::steel_body(Tie::average, Tie::average, 6);
  options.stress_recovery = RecoveryExtent::all;
  Superelement body = test::reduced(test::twisted_block(), options);
  body.quantities["gauges"] = {{"a", "b", "c"}, {"Pa", "Pa", "Pa"}, body.stress_recovery.middleRows(12, 3)};
  return body;
}

/// Returns the static stress of a body whose first interface is held, under a unit force along z on the second.
Eigen::VectorXd stress_under_load(const Superelement& body) {
  const Eigen::Index free = body.size() - 6;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(free);
  load(2) = 1;
  const Eigen::MatrixXd stiffness = body.stiffness.bottomRightCorner(free, free);
  return body.stress_recovery.rightCols(free) * few_least_squares(stiffness, load);
}

}  // namespace

TEST_CASE("Stress and quantities of a file are those of the reduced body") {
  const Superelement body = stressed_body();
  const Superelement again = test::reduced(matrix_set_of(body), {});
  CHECK(again.stress_nodes == body.stress_nodes);
  const Eigen::VectorXd expected = stress_under_load(body);
  CHECK((stress_under_load(again) - expected).cwiseAbs().maxCoeff() < 1e-7 * expected.cwiseAbs().maxCoeff());
  REQUIRE(again.quantities.count("gauges") == 1);
  const RecoveredQuantity& gauges = again.quantities.at("gauges");
  CHECK(gauges.rows == std::vector<std::string>{"a", "b", "c"});
  CHECK((gauges.matrix - again.stress_recovery.middleRows(12, 3)).cwiseAbs().maxCoeff() <
        1e-12 * again.stress_recovery.cwiseAbs().maxCoeff());
}

TEST_CASE("Columns of a recovery matrix in a wrong order are found by name") {
  MatrixSet set = matrix_set_of(stressed_body());
  CHECK(test::faults_of(set).empty());
  MatrixSet turned = set;
  const std::string unit = GENERATE("Pa", "m/m", "N");
  turned.quantities["gauges"].units.assign(3, unit);
  CHECK(test::faults_of(turned).empty());
  turned.quantities["gauges"].matrix = Eigen::MatrixXd(set.quantities["gauges"].matrix.rowwise().reverse());
  CHECK_THAT(test::faults_of(turned), Contains("rigid motions cause gauges, most at row") &&
                                          Contains("the columns of the matrix are not the unknowns"));
  set.shapes->stress.col(0).swap(set.shapes->stress.col(1));
  CHECK_THAT(test::faults_of(set), Contains("rigid motions cause stress, most at point"));
}

TEST_CASE("Stress of a body with one interface vanishes in rigid motions up to rounding of its modes") {
  ReductionOptions options = test::steel_body(Tie::average, Tie::average, 6);
  options.interfaces.resize(1);
  options.stress_recovery = RecoveryExtent::all;
  CHECK(test::faults_of(matrix_set_of(test::reduced(test::twisted_block(), options))).empty());
}

TEST_CASE("Rows of quantities get names, and can be chosen by their numbers") {
  RecoveredQuantities quantities = {{"q", {{"r1", "r2"}, {"Pa", "N"}, Eigen::MatrixXd::Identity(2, 3)}}};
  name_rows({{"q", {{"x", "y"}, {}, "rows"}}}, quantities);
  CHECK(quantities["q"].rows == std::vector<std::string>{"x", "y"});
  name_rows({{"q", {{}, {{"second", 2}}, "rows"}}}, quantities);
  CHECK(quantities["q"].units == std::vector<std::string>{"N"});
  CHECK(quantities["q"].matrix == Eigen::MatrixXd::Identity(2, 3).bottomRows(1));
  CHECK_THROWS_WITH(name_rows({{"q", {{}, {{"far", 2}}, "rows"}}}, quantities),
                    Contains("'far' is row 2, but the matrix has the rows 1 to 1"));
  CHECK_THROWS_WITH(name_rows({{"q", {{"x", "y"}, {}, "rows"}}}, quantities), Contains("a name for each of the 1 row"));
  CHECK_THROWS_WITH(name_rows({{"p", {{"x"}, {}, "rows"}}}, quantities), Contains("no quantity 'p'"));
}

TEST_CASE("Inertia relief of matrices equals that of their mesh") {
  const Mesh mesh = test::twisted_block();
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::rigid, 2);
  options.inertia_relief = true;
  MatrixOptions foreign;
  foreign.interfaces = {test::tied("a", test::node_numbers(mesh, "x0")),
                        test::tied("b", test::node_numbers(mesh, "x1"))};
  const Superelement expected = test::reduced(mesh, options);
  for (std::size_t k = 0; k < 2; ++k) foreign.interfaces[k].position = expected.interfaces[k].position;
  foreign.modes.count = 2;
  foreign.inertia_relief = true;
  MatrixSet set = test::matrices_of(mesh);
  if (GENERATE(false, true)) test::turn_nodes(set);
  const Superelement body = test::reduced(set, foreign);
  CHECK(body.residual_vectors == expected.residual_vectors);
  const InertiaAnswer &found = body.inertia_answer, &wanted = expected.inertia_answer;
  CHECK((found.whole - wanted.whole).norm() < 1e-6 * wanted.whole.norm());
  CHECK(found.missing.norm() < 1e-6 * found.whole.norm());
  foreign.inertia_relief = false;
  const Superelement without = test::reduced(set, foreign);
  CHECK(without.residual_vectors == 0);
  CHECK(without.inertia_answer.missing.norm() > 1e-3 * without.inertia_answer.whole.norm());
}

TEST_CASE("The response of a beam of nodes with rotations to its own acceleration is exact") {
  // A beam that is clamped at one end has the energy W = rho^2 g^2 L^5 / (40 EI) under g along z.
  MatrixOptions options;
  options.interfaces = {test::tied("root", {10})};
  options.modes.count = 1;
  options.inertia_relief = true;
  const Superelement body = test::reduced(test::beam_set(8), options);
  const double closed = 9 * 32.0 / (20 * 2e4);  // twice the energy: rho = 3, L = 2, EI = 2e4
  // The elements lack the deflection between their nodes, a share of 7e-6.
  CHECK(body.inertia_answer.whole(8, 8) == Approx(closed).epsilon(1e-4));
  CHECK(std::abs(body.inertia_answer.missing(8, 8)) < 1e-6 * closed);
}

TEST_CASE("Cells between nodes become cells of the superelement's mesh") {
  const Mesh mesh = test::twisted_block();
  MatrixSet set = test::matrices_of(mesh);
  const auto cells = test::reduced(mesh, test::steel_body(Tie::rigid, Tie::rigid, 1)).mesh.cells;
  REQUIRE_FALSE(cells.empty());
  set.cells = cells;
  MatrixOptions options;
  options.interfaces = {test::tied("a", test::node_numbers(mesh, "x0"))};
  options.modes.count = 2;
  const Superelement body = test::reduced(set, options);
  CHECK(body.mesh.cells == cells);
}

TEST_CASE("Only the ratios of weights matter for a tie of nodes") {
  const Mesh mesh = test::twisted_block();
  MatrixOptions options;
  options.interfaces = {test::tied("a", test::node_numbers(mesh, "x0"), Tie::average)};
  options.modes.count = 2;
  const auto stiffness = [&](double factor) {
    std::vector<double>& weights = options.interfaces[0].weights;
    weights.assign(options.interfaces[0].nodes.size(), factor);
    weights[0] = 3 * factor;
    return test::reduced(test::matrices_of(mesh), options).frequencies(0);
  };
  const double expected = stiffness(1);
  for (const double factor : {1e300, 1e-300, 1e30}) CHECK(stiffness(factor) == Approx(expected).epsilon(1e-9));
  options.interfaces[0].weights[0] = 1e300;
  CHECK_THROWS_WITH(test::reduced(test::matrices_of(mesh), options), Contains("differ by a factor of 1e8 at most"));
}
