// Beams whose section changes along them, and the stresses that beams record.
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "mechanism/elements/beam/beam_element.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "tests/support/dense_solution.hpp"
#include "tests/support/static_model.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::StaticModel;
using Catch::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using std::numbers::pi;

namespace {

std::string beam(int elements, const std::string& section, const std::string& root = ", fixed: true") {
  return "nodes: {root: {position: [0, 0, 0]" + root + "}, tip: {position: [2, 0, 0]}}\nelements: {b: {type: beam, " +
         "nodes: [root, tip], orientation: [0, 1, 0], elements: " + std::to_string(elements) + ", section: " + section +
         "}}\n";
}

/// Returns the displacements of the tip under a unit force along y there, linear.
Vector6 unit_tip(const std::string& yaml) {
  const StaticModel model(yaml);
  VectorX f = VectorX::Zero(static_cast<Eigen::Index>(model.free.size()));
  f[1] = 1;
  return bielle::test::solution(model.stiffness(), f).head<6>();
}

}  // namespace

TEST_CASE("the deflection of a tapered cantilever converges with the sixth power of the element length") {
  // EIz = 3 - x, GAy = 50 on the length 2: w = int (2-x)^2/(3-x) dx + 2/50 = ln 3 + 1/25, theta = int (2-x)/(3-x) dx.
  const std::string section =
      "[{EA: 10, GAy: 50, GAz: 50, GJ: 1, EIy: 1, EIz: 3}, {EA: 10, GAy: 50, GAz: 50, GJ: 1, EIy: 1, EIz: 1}]";
  std::vector<double> errors;
  for (int elements : {1, 2, 4}) {
    const Vector6 tip = unit_tip(beam(elements, section));
    errors.push_back(std::hypot(tip[1] - std::log(3.0) - 0.04, tip[5] - (2 - std::log(3.0))));
  }
  CAPTURE(errors);
  CHECK(errors[0] < 1e-2);
  CHECK(std::log2(errors[1] / errors[2]) > 5);
}

TEST_CASE("a tapered bar has its mass, centre and inertia exactly") {
  // Radius 0.1 (1 + x) on the length 2: int r^2 x^k dx, k = 0, 1, 2.
  const StaticModel model(beam(
      1, "[{circle: 0.1, young: 1, shear: 1, density: 100}, {circle: 0.3, young: 1, shear: 1, density: 100}]", ""));
  const MatrixX M = model.dense.tangent(model.state, DenseModel::Part::M);
  VectorX move = VectorX::Zero(model.dense.size()), turn = move;
  for (const char* node : {"root", "tip"}) move[model.unknown(node, 1)] = turn[model.unknown(node, 5)] = 1;
  turn[model.unknown("tip", 1)] = 2;
  const auto moment = [](int k) {  // integral of (1 + x)^2 x^k over [0, 2]
    const auto power = [](int n) { return std::pow(2.0, n + 1) / (n + 1); };
    return pi * (power(k) + 2 * power(k + 1) + power(k + 2));
  };
  CHECK_THAT(move.dot(M * move), WithinRel(moment(0), 1e-13));
  CHECK_THAT(move.dot(M * turn), WithinRel(moment(1), 1e-13));
  CHECK_THAT(dynamic_cast<const BeamElement&>(*model.model->members()[0].component).mass(),
             WithinRel(moment(0), 1e-14));
  // Rotary inertia: rho pi r^4/4, a quartic.
  const double rotary = 100 * pi / 4 * 1e-4 * (std::pow(3.0, 5) - 1) / 5;
  CHECK_THAT(turn.dot(M * turn), WithinRel(moment(2) + rotary, 1e-13));
}

TEST_CASE("with constant strain a tapered element has the mean of its sections") {
  // EA = 3 pi 0.01 (1 + x)^2 on the length 2: 13/3 of its start in the mean.
  std::string yaml = beam(1, "[{circle: 0.1, young: 3, shear: 1}, {circle: 0.3, young: 3, shear: 1}]");
  yaml.replace(yaml.find("elements: 1,"), 12, "elements: 1, bending: constant,");
  const StaticModel model(yaml);
  CHECK_THAT(model.stiffness()(0, 0), WithinRel(3 * pi * 0.01 * 13 / 3 / 2, 1e-14));
}

TEST_CASE("a conical bar held at both ends has the axial frequencies of a uniform one") {
  // (r u)'' + k^2 r u = 0 for r linear along the bar: omega_n = n pi c/L, c^2 = E/rho = 0.04.
  const auto error = [](int elements) {
    StaticModel model(
        beam(elements,
             "[{circle: 0.1, young: 4, shear: 1, density: 100}, {circle: 0.3, young: 4, shear: 1, density: 100}]"));
    model.keep_directions({0});
    model.hold("tip", 0);
    const MatrixX K = model.stiffness(),
                  M = model.dense.tangent(model.state, DenseModel::Part::M)(model.free, model.free);
    const bielle::SymmetricEigenpairs eigen = bielle::symmetric_eigenpairs(K, M).value();
    const double exact = 2 * pi * 0.2 / 2;
    return std::abs(std::sqrt(eigen.values[1]) / exact - 1);
  };
  const double coarse = error(8), fine = error(16), finest = error(32), last = error(64);
  CAPTURE(coarse, fine, finest, last);
  CHECK(last < 1e-3);
  CHECK(std::log2(coarse / fine) > 1.9);
  CHECK(std::log2(fine / finest) > 1.9);
  CHECK_THAT(std::log2(finest / last), WithinAbs(2, 0.1));  // from above: terms of fourth order fade away
}

TEST_CASE("bending and torsional frequencies of a tapered beam converge with the second power of the element length") {
  // The beam is so slender that the second-order part, which uniform beams have as well, is small.
  const auto frequencies = [](int elements, const std::vector<int>& directions) {
    StaticModel model(beam(elements,
                           "[{circle: 0.02, young: 4e4, shear: 1.5e4, density: 100}, {circle: 0.01, young: 4e4, shear: "
                           "1.5e4, density: 100}]"));
    model.keep_directions(directions);
    const MatrixX K = model.stiffness(),
                  M = model.dense.tangent(model.state, DenseModel::Part::M)(model.free, model.free);
    const bielle::SymmetricEigenpairs eigen = bielle::symmetric_eigenpairs(K, M).value();
    return Eigen::Vector2d(eigen.values.head<2>().cwiseSqrt());
  };
  for (const std::vector<int>& directions : {std::vector<int>{1, 5}, {3}}) {
    std::vector<Eigen::Vector2d> f;
    for (const int elements : {4, 8, 16, 32, 64}) f.push_back(frequencies(elements, directions));
    for (int mode = 0; mode < 2; ++mode) {
      std::vector<double> change;
      for (std::size_t k = 0; k + 1 < f.size(); ++k)
        change.push_back(std::abs(f[k][mode] - f[k + 1][mode]) / f[4][mode]);
      CAPTURE(directions, mode, change);
      CHECK(std::log2(change[1] / change[2]) > 1.9);
      CHECK(std::log2(change[2] / change[3]) > 1.9);
      CHECK(change[3] < 1e-3);
    }
  }
}

TEST_CASE("a beam records the stresses of its resultants at the stress points") {
  // Cantilever 2 m, 0.2 x 0.4 m, P = 3 N down (z) at the tip and 5 N m about x: in the middle of the second of two
  // elements M_y = P 0.5, V = -P.
  const double tiny = 1e-3;  // linear
  StaticModel model(
      beam(2, "{rectangle: [0.2, 0.4], young: 2e6, poisson: 0.25, stress_points: [[0.1, 0.2], [0, 0], [0, 0.2]]}") +
      "loads: {p: {node: tip, force: [0, 0, -3e-3], moment: [5e-3, 0, 0]}}\n");
  REQUIRE(model.load(1, 1e-9) >= 0);
  const Component& last = *model.model->members()[1].component;
  Slots slots;
  slots.nodes = {*model.model->find_node("b.1"), *model.model->find_node("tip")};
  slots.memory_begin = 3;
  slots.memories = 3;
  VectorX out(12 + 9 + 3);
  last.write_output({model.state, slots, model.dense.environment}, out.data());
  REQUIRE(last.output_fields().size() == 4);
  CHECK(last.output_fields()[2].shape == std::vector<std::size_t>{3, 3});
  const double I = 0.2 * 0.064 / 12, A = 0.08;
  CHECK_THAT(out[12] / tiny, WithinRel(3 * 0.5 * 0.2 / I, 1e-4));  // corner: bending alone
  CHECK_THAT(out[13] / tiny, WithinAbs(0, 2e-2 * 5 / 0.4 / 0.04));
  CHECK_THAT(out[12 + 5] / tiny, WithinRel(-1.5 * 3 / A, 1e-4));  // centroid: shear alone
  CHECK_THAT(out[12 + 3] / tiny, WithinAbs(0, 1e-3));
  const double tau = out[12 + 7] / tiny;  // above: bending and torsion, k = 0.2459 for 2:1
  CHECK_THAT(std::abs(tau), WithinRel(0.796 * 5 / (0.2459 * 0.4 * 0.04), 3e-2));
  const double sigma = out[12 + 6] / tiny;
  CHECK_THAT(out[12 + 9 + 2] / tiny, WithinRel(std::sqrt(sigma * sigma + 3 * tau * tau), 1e-6));
}

TEST_CASE("a section cannot taper between shapes or hold points that leave it") {
  const auto read = [](const std::string& section) { StaticModel model(beam(2, section)); };
  CHECK_THROWS_WITH(read("[{circle: 1, young: 1, shear: 1, stress_points: [[0, 1]]}, {circle: 1, young: 1, shear: 1}]"),
                    Contains("as many `stress_points`"));
  CHECK_THROWS_WITH(read("[{circle: 1, young: 1, shear: 1, shear_factors: [1, 1]}, {circle: 1, young: 1, shear: 1}]"),
                    Contains("`shear_factors` at both ends"));
  CHECK_THROWS_WITH(read("{i: {width: 1, height: 1, web: 2, flange: 0.1}, young: 1, shear: 1}"), Contains("web"));
  CHECK_THROWS_WITH(read("{i: {width: 1, height: 1, web: 0.1, flange: [0.5, 0.6]}, young: 1, shear: 1}"),
                    Contains("flange"));
  CHECK_THROWS_WITH(read("{box: {width: 1, height: 1, thickness: 0.5}, young: 1, shear: 1}"), Contains("hollow"));
  CHECK_THROWS_WITH(read("{t: {width: 1, height: 1, web: 0.1}, young: 1, shear: 1}"), Contains("flange"));
  CHECK_THROWS_WITH(read("{t: [1, 2], young: 1, shear: 1}"), Contains("section"));
}
