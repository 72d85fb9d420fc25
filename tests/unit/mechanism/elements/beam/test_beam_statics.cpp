// Linear statics of beams: cantilevers, a quarter ring, the twisted beam. (Large deformation: tests/benchmarks/beams.)
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "mechanism/math/se3.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/dense_solution.hpp"
#include "tests/support/model_text.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::model_from_text;
using bielle::test::solve_static;
using std::numbers::pi;

namespace {

/// Returns all unknowns of the nodes after `first`.
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
  // Constant strain lacks a quarter of the bending: P L^3/(4 EI).
  Cantilever stiff(
      "nodes: {root: {position: [0, 0, 0]}, tip: {position: [2, 0, 0]}}\n"
      "elements: {b: {type: beam, nodes: [root, tip], elements: 1, bending: constant, "
      "section: {EA: 1e3, GAy: 50, GAz: 40, GJ: 2, EIy: 5, EIz: 3}}}\n"
      "loads: {p: {node: tip, force: [0, 1e-5, 0]}}\n");
  stiff.load(1, 1e-12);
  CHECK_THAT(stiff.tip().x.y(), Catch::WithinRel(P * (L * L * L / 12 + L / 50), 1e-9));
}

namespace {

/// Returns the deflection of the tip under a unit force there, by the stiffness at the reference.
Vector3 unit_deflection(const std::string& yaml, const Vector3& force) {
  const Cantilever beam(yaml);
  const std::vector<int> free = free_from(beam.dense, 2);
  VectorX f = VectorX::Zero(static_cast<Eigen::Index>(free.size()));
  f.head<3>() = force;
  return bielle::test::solution(beam.dense.tangent(beam.state, DenseModel::Part::K)(free, free), f).head<3>();
}

/// Errors of a deflection: of second order with constant strain, none with the residual flexibility.
template <class Deflection>
void check_deflection(double exact, const Deflection& deflection) {
  std::vector<double> errors;
  for (int elements : {4, 8, 16, 32}) errors.push_back(std::abs(deflection(elements, "constant") / exact - 1));
  CAPTURE(errors);
  CHECK_THAT(std::log2(errors[2] / errors[3]), Catch::WithinAbs(2, 0.05));
  CHECK(errors[3] < 2e-3);
  for (int elements : {1, 3}) CHECK_THAT(deflection(elements, "residual"), Catch::WithinRel(exact, 2e-10));
}

}  // namespace

TEST_CASE("a quarter ring deflects in and out of its plane as Castigliano says") {
  // R = 2, clamped at one end, unit force at the other. With theta from the tip: in the plane, across the tip's
  // tangent, M = R sin, N = sin, V = cos; out of the plane bending R sin, torsion R (1 - cos), shear 1.
  const double R = 2, EA = 40, GA = 15, GJ = 3, EI_out = 5, EI_in = 4;
  const double in_plane = pi / 4 * (R * R * R / EI_in + R / EA + R / GA);
  const double out_of_plane = R * R * R * (pi / 4 / EI_out + (3 * pi / 4 - 2) / GJ) + pi / 2 * R / GA;
  const auto ring = [](int elements, const std::string& bending) {
    return "nodes: {root: {position: [2, 0, 0]}, tip: {position: [0, 2, 0], rotation_vector: [1, 2, 3]}}\n"
           "elements: {b: {type: beam, nodes: [root, tip], arc_centre: [0, 0, 0], elements: " +
           std::to_string(elements) + ", bending: " + bending +
           ", section: {EA: 40, GAy: 15, GAz: 15, GJ: 3, EIy: 5, EIz: 4}}}\n";
  };
  // The tip's tangent is -x: across it is y; the section's y lies in the plane.
  check_deflection(in_plane,
                   [&](int n, const char* bending) { return unit_deflection(ring(n, bending), Vector3::UnitY()).y(); });
  check_deflection(out_of_plane,
                   [&](int n, const char* bending) { return unit_deflection(ring(n, bending), Vector3::UnitZ()).z(); });
}

TEST_CASE("an arc that is twisted has the exact flexibility of its rod") {
  // A quarter circle of radius 2 about z, section turned by 1.5 on the way: a wrench at the tip gives the resultants
  // A (n, m) in the section's axes, and moves the tip by the sum of A^T C^-1 A along the line.
  Vector6 compliance;
  compliance << 1 / 40.0, 1 / 15.0, 1 / 12.0, 1 / 3.0, 1 / 5.0, 1 / 0.7;
  Matrix6 F = Matrix6::Zero();
  const Vector3 end(0, 2, 0);
  Matrix3 start;
  start << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  constexpr int parts = 2000;
  for (int k = 0; k <= 2 * parts; ++k) {
    const double s = k / (2.0 * parts), weight = (k % 2 ? 4 : (k == 0 || k == 2 * parts) ? 1 : 2) / (6.0 * parts);
    const Matrix3 R = exp_so3({0, 0, s * pi / 2}) * start * exp_so3({1.5 * s, 0, 0});
    Matrix6 A = Matrix6::Zero();
    A.topLeftCorner<3, 3>() = A.bottomRightCorner<3, 3>() = R.transpose();
    A.bottomLeftCorner<3, 3>() = R.transpose() * skew(end - 2 * Vector3(std::cos(s * pi / 2), std::sin(s * pi / 2), 0));
    F += weight * pi * A.transpose() * compliance.asDiagonal() * A;
  }
  for (const int elements : {1, 3}) {
    const Cantilever beam(
        "nodes: {root: {position: [2, 0, 0]}, tip: {position: [0, 2, 0]}}\n"
        "elements: {b: {type: beam, nodes: [root, tip], arc_centre: [0, 0, 0], twist: 1.5, orientation: [-1, 0, 0], "
        "elements: " +
        std::to_string(elements) + ", section: {EA: 40, GAy: 15, GAz: 12, GJ: 3, EIy: 5, EIz: 0.7}}}\n");
    const std::vector<int> free = free_from(beam.dense, 2);
    const MatrixX K = beam.dense.tangent(beam.state, DenseModel::Part::K)(free, free);
    const Matrix6 computed = K.inverse().topLeftCorner<6, 6>();
    // One element integrates its right angle in 16 parts of 6th order.
    CHECK((computed - F).cwiseAbs().maxCoeff() < (elements == 1 ? 2e-10 : 1e-12) * F.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("the twisted beam of MacNeal and Harder") {
  // R. MacNeal, R. Harder, Finite Elem. Anal. Des. 1 (1985) 3: L = 12, 1.1 x 0.32, twist 90 degrees, E = 29e6, nu =
  // 0.22; published 5.424e-3 and 1.754e-3. Here the exact linear solution of the pre-twisted Timoshenko rod (k = 5/6)
  // (tests/references/twisted_beam.py).
  const bielle::test::ReferenceTable exact("twisted_beam");
  const auto twisted = [](int elements, const std::string& bending, const std::string& shear = "") {
    return "nodes: {root: {position: [0, 0, 0]}, tip: {position: [12, 0, 0]}}\n"
           "elements: {b: {type: beam, nodes: [root, tip], orientation: [0, 1, 0], twist: pi/2, elements: " +
           std::to_string(elements) + ", bending: " + bending +
           ", section: {rectangle: [0.32, 1.1], young: 29e6, poisson: 0.22" + shear + "}}}\n";
  };
  check_deflection(exact("shear.y"), [&](int n, const char* bending) {
    return unit_deflection(twisted(n, bending), Vector3::UnitY()).y();
  });
  check_deflection(exact("shear.z"), [&](int n, const char* bending) {
    return unit_deflection(twisted(n, bending), Vector3::UnitZ()).z();
  });
  // If it is stiff in shear, it is the pre-twisted Bernoulli rod.
  const std::string stiff = ", shear_factors: [1e8, 1e8]";
  for (const int n : {1, 3}) {
    CHECK_THAT(unit_deflection(twisted(n, "residual", stiff), Vector3::UnitY()).y(),
               Catch::WithinRel(exact("bending.y"), 1e-8));
    CHECK_THAT(unit_deflection(twisted(n, "residual", stiff), Vector3::UnitZ()).z(),
               Catch::WithinRel(exact("bending.z"), 1e-8));
    CHECK_THAT(std::abs(unit_deflection(twisted(n, "residual", stiff), Vector3::UnitZ()).y()),
               Catch::WithinRel(exact("bending.cross"), 1e-8));
  }
  // The cross flexibility is symmetric.
  const double yz = unit_deflection(twisted(8, "residual"), Vector3::UnitY()).z();
  CHECK_THAT(yz, Catch::WithinRel(unit_deflection(twisted(8, "residual"), Vector3::UnitZ()).y(), 1e-9));
  CHECK_THAT(std::abs(yz), Catch::WithinRel(exact("shear.cross"), 1e-4));
}

TEST_CASE("the straight and the curved beam of MacNeal and Harder are beam theory's, near the published values") {
  // Straight: 6 x 0.2 x 0.1, E = 1e7, nu = 0.3; 0.1081 in the plane, 0.4321 out of it, 3.0e-5 along. Curved: quarter
  // circle between 4.12 and 4.32, 0.1 thick, E = 1e7, nu = 0.25; 0.08734 and 0.5022 (plane elasticity and a thick bar:
  // some per cent from the theory of slender beams).
  const std::string straight =
      "nodes: {root: {position: [0, 0, 0]}, tip: {position: [6, 0, 0]}}\nelements: {b: {type: beam, nodes: [root, "
      "tip], "
      "elements: 1, orientation: [0, 1, 0], section: {rectangle: [0.2, 0.1], young: 1e7, poisson: 0.3}}}\n";
  CHECK_THAT(unit_deflection(straight, Vector3::UnitX()).x(), Catch::WithinRel(3e-5, 1e-12));
  CHECK_THAT(unit_deflection(straight, Vector3::UnitY()).y(), Catch::WithinRel(0.1081, 5e-4));
  CHECK_THAT(unit_deflection(straight, Vector3::UnitZ()).z(), Catch::WithinRel(0.4321, 5e-4));
  const std::string curved =
      "nodes: {root: {position: [4.22, 0, 0]}, tip: {position: [0, 4.22, 0]}}\nelements: {b: {type: beam, nodes: "
      "[root, "
      "tip], elements: 4, arc_centre: [0, 0, 0], orientation: [1, 0, 0], section: {rectangle: [0.2, 0.1], young: 1e7, "
      "poisson: 0.25}}}\n";
  CHECK_THAT(unit_deflection(curved, Vector3::UnitY()).y(), Catch::WithinRel(0.08734, 2e-2));
  CHECK_THAT(unit_deflection(curved, Vector3::UnitZ()).z(), Catch::WithinRel(0.5022, 1e-2));
}

TEST_CASE("the recorded resultants balance the load in the middle of every element, however bent the beam") {
  Cantilever beam(
      "nodes: {root: {position: [0, 0, 0]}, tip: {position: ['100 - 50*sqrt(2)', '50*sqrt(2)', 0]}}\n"
      "elements: {b: {type: beam, nodes: [root, tip], arc_centre: [100, 0, 0], elements: 4, section: {EA: 1e7, GAy: "
      "5e6, "
      "GAz: 5e6, GJ: 5e6/6, EIy: 1e7/12, EIz: 1e7/12}}}\nloads: {p: {node: tip, force: [0, 0, 600], moment: [0, 900, "
      "0]}}\n");
  beam.load(24, 1e-6);
  const std::vector<int> nodes{1, 3, 4, 5, 2};
  for (std::size_t k = 0; k < 4; ++k) {
    Slots slots;
    slots.nodes = {nodes[k], nodes[k + 1]};
    slots.memory_begin = static_cast<int>(3 * k);
    slots.memories = 3;
    VectorX out(12);
    beam.model->members()[k].component->write_output({beam.state, slots, beam.dense.environment}, out.data());
    // Section frames: those of the inner nodes; at the ends the node frames are turned against them.
    const auto section = [&](std::size_t i) {
      const NodeState& node = beam.state.nodes[static_cast<std::size_t>(nodes[i])];
      Matrix3 R = node.R;
      if (i == 0 || i == 4) {
        const double angle = i == 0 ? 0 : pi / 4;  // angle of the arc; the section's y is the inertial x of the start
        Matrix3 start;
        start << 0, 1, 0, 1, 0, 0, 0, 0, -1;
        R = node.R * exp_so3(Vector3(0, 0, -angle)) * start;
      }
      return Frame{node.x, R};
    };
    const Frame A = section(k), B = section(k + 1);
    const Frame middle = A * exp_se3(0.5 * log_se3(inverse(A) * B));
    const Vector3 force = middle.R * out.segment<3>(6), moment = middle.R * out.segment<3>(9);
    CHECK((force - Vector3(0, 0, 600)).norm() < 1e-6);
    CHECK((moment - (beam.tip().x - middle.x).cross(Vector3(0, 0, 600)) - Vector3(0, 900, 0)).norm() < 1e-4);
  }
}
