#include <cmath>
#include <memory>

#include <catch2/catch.hpp>

#include "reduce/reduction/missed_modes.hpp"
#include "tests/unit/reduce/reduction/bodies.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Eigen::Index;

namespace {

struct HeldModel {
  Mesh mesh;
  Solid solid;
  Ties ties;
  std::unique_ptr<BodyMatrices> matrices;
  FixedInterfaceBody held;
  Basis basis;

  HeldModel(Mesh m, const std::vector<InterfaceRequest>& requests, int modes)
      : mesh(std::move(m)),
        solid(make_solid(mesh, {{"steel", test::steel()}}, {{"all", "steel"}})),
        ties(make_ties(solid, requests)),
        matrices(assembled_matrices(solid, HeldFreedoms(solid, ties).interior(), 2)),
        held(HeldFreedoms(solid, ties), solid, *matrices, ties, 2) {
    Progress quiet(true);
    basis = make_basis(solid, *matrices, ties, held, mass_properties(solid), {modes, std::nullopt}, quiet, 2);
  }
  HeldModel(const HeldModel&) = delete;

  std::optional<ModeCount> count() const { return count_modes(*matrices, held, basis); }
  /// Removes mode k, as if the eigensolver had not found it.
  void forget(Index k) {
    std::vector<double> left(basis.eigenvalues.begin(), basis.eigenvalues.end());
    left.erase(left.begin() + k);
    basis.eigenvalues = Eigen::Map<Eigen::VectorXd>(left.data(), static_cast<Index>(left.size()));
    basis.shapes = RowMatrix(basis.shapes.leftCols(basis.shapes.cols() - 1));
  }
};

std::vector<InterfaceRequest> both_ends(Tie a, Tie b) {
  return {test::interface("a", "x0", a), test::interface("b", "x1", b)};
}

}  // namespace

TEST_CASE("missed modes: the pivots count the modes below any frequency, for any ties", "[reduction]") {
  std::vector<InterfaceRequest> requests;
  switch (GENERATE(0, 1, 2, 3)) {
    case 0:  // held by fixed degrees of freedom alone, with two rotations released
      requests = both_ends(Tie::rigid, Tie::rigid);
      requests[1].kept = {true, true, true, false, true, false};
      break;
    case 1:  // held by averages alone: six supports are left out of the factor
      requests = both_ends(Tie::average, Tie::average);
      requests[1].kept = {true, false, true, false, true, false};
      break;
    case 2:  // a ball joint, and an average
      requests = both_ends(Tie::rigid, Tie::average);
      requests[0].kept = {true, true, true, false, false, false};
      break;
    default:
      requests = both_ends(Tie::rigid, Tie::average);
  }
  HeldModel model(test::twisted_block(), requests, 12);
  const Eigen::VectorXd& values = model.basis.eigenvalues;
  for (Index k = 0; k + 1 < values.size(); ++k) {
    CAPTURE(k);
    const auto signs = model.held.count_below(*model.matrices, (values(k) + values(k + 1)) / 2);
    REQUIRE(signs);
    CHECK(signs->negative == k + 1);
    CHECK(signs->growth < 1e6);
  }
  CHECK(model.held.count_below(*model.matrices, values(0) / 2)->negative == 0);
  const std::optional<ModeCount> count = model.count();
  REQUIRE(count);
  CHECK(count->found == 12);
  CHECK(count->counted == 12);
  const double shift = std::pow(2 * M_PI * count->below, 2);
  CHECK(shift > values(11));
  REQUIRE(model.basis.next);
  CHECK(shift < *model.basis.next);
  // If the next mode is not known, the count is made slightly above the last one.
  model.basis.next.reset();
  const std::optional<ModeCount> above = model.count();
  REQUIRE(above);
  CHECK(above->found == 12);
  CHECK(std::pow(2 * M_PI * above->below, 2) > values(11));
  CHECK(std::pow(2 * M_PI * above->below, 2) < 1.01 * values(11));
}

TEST_CASE("missed modes: a missing mode of a pair is noticed", "[reduction]") {
  // A square bar has pairs of bending frequencies, which differ only by rounding and by the mesh.
  HeldModel bar(test::box_mesh({{4, 0.2, 0.2}, {12, 2, 2}}), both_ends(Tie::rigid, Tie::rigid), 10);
  REQUIRE(bar.count());
  CHECK(bar.count()->counted == bar.count()->found);
  const Eigen::VectorXd values = bar.basis.eigenvalues;
  REQUIRE(values(1) / values(0) - 1 < 0.01);
  bar.forget(1);
  const std::optional<ModeCount> count = bar.count();
  REQUIRE(count);
  CHECK(count->counted == count->found + 1);
}

TEST_CASE("missed modes: a reduction stores the result of a requested count", "[reduction]") {
  ReductionOptions options = test::steel_body(Tie::rigid, Tie::average, 8);
  ReductionReport report;
  CHECK_FALSE(test::reduced(test::twisted_block(), options).checks.contains("missed_modes"));
  options.modes_proven = true;
  const Superelement body = test::reduced(test::twisted_block(), options, &report);
  REQUIRE(body.checks.contains("missed_modes"));
  CHECK(body.checks.at("missed_modes") == 0);
  CHECK(report.checks.back().name == "missed_modes");
  CHECK_THAT(report.checks.back().meaning, Catch::Contains("8 modes below"));
}
