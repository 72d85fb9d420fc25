// Linear statics of beams: cantilevers, a quarter ring, the twisted beam. (Large deformation: tests/benchmarks/beams.)
#include <cmath>
#include <numeric>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "tests/support/dense_model.hpp"
#include "tests/support/model_text.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::model_from_text;
using bielle::test::solve_static;

namespace {

const double pi = 3.141592653589793;

/// All unknowns of the nodes after `first`.
std::vector<int> free_from(const DenseModel& dense, int first) {
  std::vector<int> free(static_cast<std::size_t>(6 * (dense.nodes() - first)));
  std::iota(free.begin(), free.end(), 6 * first);
  return free;
}

/// A cantilever: node 1 `root` is held, node 2 `tip` loaded; internal nodes follow.
struct Cantilever {
  std::unique_ptr<Model> model;
  DenseModel dense;
  State state;
  explicit Cantilever(const std::string& yaml) : model(model_from_text(yaml)), dense(*model), state(dense.start()) {}
  const NodeState& tip() const { return state.nodes[2]; }
  /// Raises the load factor to 1 in equal steps. @returns the most iterations that a step needed
  int load(int steps, double tolerance) {
    int most = 0;
    for (int k = 1; k <= steps; ++k) {
      dense.environment.load_factor = static_cast<double>(k) / steps;
      const int iterations = solve_static(dense, state, free_from(dense, 2), tolerance);
      REQUIRE(iterations >= 0);
      most = std::max(most, iterations);
    }
    return most;
  }
};

}  // namespace

TEST_CASE("one element gives the tip deflection of a Timoshenko cantilever exactly") {
  // P small: linear. L = 2, EIz = 3, GAy = 50 along y; EIy = 5, GAz = 40 along z.
  const double P = 1e-5, L = 2;
  for (int elements : {1, 3}) {
    Cantilever beam(
        "nodes: {root: {position: [0, 0, 0]}, tip: {position: [2, 0, 0]}}\n"
        "elements: {b: {type: beam, nodes: [root, tip], elements: " +
        std::to_string(elements) +
        ", section: {EA: 1e3, GAy: 50, GAz: 40, GJ: 2, EIy: 5, EIz: 3}}}\n"
        "loads: {p: {node: tip, force: [0, 1e-5, 1e-5]}}\n");
    beam.load(1, 1e-12);
    // Geometric non-linearity is of relative order (w/L)^2 = 3e-11.
    CHECK_THAT(beam.tip().x.y(), Catch::WithinRel(P * (L * L * L / 9 + L / 50), 1e-9));
    CHECK_THAT(beam.tip().x.z(), Catch::WithinRel(P * (L * L * L / 15 + L / 40), 1e-9));
    CHECK_THAT(log_so3(beam.tip().R).z(), Catch::WithinRel(P * L * L / 6, 1e-9));
  }
  // Constant strain misses a quarter of the bending: P L^3/(4 EI).
  Cantilever stiff(
      "nodes: {root: {position: [0, 0, 0]}, tip: {position: [2, 0, 0]}}\n"
      "elements: {b: {type: beam, nodes: [root, tip], elements: 1, bending: constant, "
      "section: {EA: 1e3, GAy: 50, GAz: 40, GJ: 2, EIy: 5, EIz: 3}}}\n"
      "loads: {p: {node: tip, force: [0, 1e-5, 0]}}\n");
  stiff.load(1, 1e-12);
  CHECK_THAT(stiff.tip().x.y(), Catch::WithinRel(P * (L * L * L / 12 + L / 50), 1e-9));
}

namespace {

/// Deflection of the tip under a unit force there, by the stiffness at the reference.
Vector3 unit_deflection(const std::string& yaml, const Vector3& force) {
  const Cantilever beam(yaml);
  const std::vector<int> free = free_from(beam.dense, 2);
  VectorX f = VectorX::Zero(static_cast<Eigen::Index>(free.size()));
  f.head<3>() = force;
  return beam.dense.tangent(beam.state, DenseModel::Part::K)(free, free).partialPivLu().solve(f).head<3>();
}

/// Relative errors for 4, 8, 16, 32 elements.
template <class Deflection>
std::vector<double> deflection_errors(double exact, const Deflection& deflection) {
  std::vector<double> errors;
  for (int elements : {4, 8, 16, 32}) errors.push_back(std::abs(deflection(elements) / exact - 1));
  return errors;
}

void check_second_order(const std::vector<double>& errors, double last) {
  CAPTURE(errors);
  for (std::size_t k = 1; k < errors.size(); ++k) CHECK(errors[k - 1] / errors[k] > (k == 1 ? 3.6 : 3.9));
  CHECK(errors.back() < last);
}

}  // namespace

TEST_CASE("a quarter ring deflects in and out of its plane as Castigliano says") {
  // R = 2, clamped at one end, unit force at the other. With theta from the tip: in the plane, across the tip's
  // tangent, M = R sin, N = sin, V = cos; out of the plane bending R sin, torsion R (1 - cos), shear 1.
  const double R = 2, EA = 40, GA = 15, GJ = 3, EI_out = 5, EI_in = 4;
  const double in_plane = pi / 4 * (R * R * R / EI_in + R / EA + R / GA);
  const double out_of_plane = R * R * R * (pi / 4 / EI_out + (3 * pi / 4 - 2) / GJ) + pi / 2 * R / GA;
  const auto ring = [](int elements) {
    return "nodes: {root: {position: [2, 0, 0]}, tip: {position: [0, 2, 0], rotation_vector: [1, 2, 3]}}\n"
           "elements: {b: {type: beam, nodes: [root, tip], arc_centre: [0, 0, 0], elements: " +
           std::to_string(elements) + ", section: {EA: 40, GAy: 15, GAz: 15, GJ: 3, EIy: 5, EIz: 4}}}\n";
  };
  // The tip's tangent is -x: across it is y; the section's y lies in the plane.
  check_second_order(deflection_errors(in_plane, [&](int n) { return unit_deflection(ring(n), Vector3::UnitY()).y(); }),
                     2e-4);
  check_second_order(
      deflection_errors(out_of_plane, [&](int n) { return unit_deflection(ring(n), Vector3::UnitZ()).z(); }), 2e-4);
}

TEST_CASE("the twisted beam of MacNeal and Harder") {
  // R. MacNeal, R. Harder, Finite Elem. Anal. Des. 1 (1985) 3: L = 12, 1.1 x 0.32, twist 90 degrees, E = 29e6, nu =
  // 0.22; published 5.424e-3 and 1.754e-3. Here the exact linear solution of the pre-twisted Timoshenko rod (k = 5/6),
  // by shooting.
  const auto twisted = [](int elements) {
    return "nodes: {root: {position: [0, 0, 0]}, tip: {position: [12, 0, 0]}}\n"
           "elements: {b: {type: beam, nodes: [root, tip], orientation: [0, 1, 0], twist: pi/2, elements: " +
           std::to_string(elements) + ", section: {rectangle: [0.32, 1.1], young: 29e6, poisson: 0.22}}}\n";
  };
  check_second_order(
      deflection_errors(5.4293214784e-3, [&](int n) { return unit_deflection(twisted(n), Vector3::UnitY()).y(); }),
      1e-3);
  check_second_order(
      deflection_errors(1.7496233389e-3, [&](int n) { return unit_deflection(twisted(n), Vector3::UnitZ()).z(); }),
      1e-3);
  // The cross flexibility is symmetric.
  CHECK_THAT(unit_deflection(twisted(8), Vector3::UnitY()).z(),
             Catch::WithinRel(unit_deflection(twisted(8), Vector3::UnitZ()).y(), 1e-9));
}
