// Inertia of beams: frequencies against Timoshenko's theory, mass properties, conservation.
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "mechanism/elements/rigid_body/mass_properties.hpp"
#include "reduce/dense/dense_solves.hpp"
#include "reduce/dense/symmetric_eigenpairs.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/finite_difference.hpp"
#include "tests/support/model_text.hpp"
#include "tests/support/random.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::model_from_text;
using bielle::test::Random;
using std::numbers::pi;
using Part = bielle::test::DenseModel::Part;

namespace {

/// Returns the natural frequencies [rad/s] of a model about its start in the given unknowns, ascending.
VectorX frequencies(const Model& model, const std::vector<int>& free) {
  const DenseModel dense(model);
  const State state = dense.start();
  const MatrixX K = dense.tangent(state, Part::K)(free, free), M = dense.tangent(state, Part::M)(free, free);
  const bielle::SymmetricEigenpairs eigen = bielle::symmetric_eigenpairs(0.5 * (K + K.transpose()), M).value();
  return eigen.values.cwiseMax(0).cwiseSqrt();
}

/// Returns a beam of unit length along x; nodes: 1 and 2 the ends, then the inner ones.
std::unique_ptr<Model> unit_beam(int elements, const std::string& section, const std::string& more = "") {
  return model_from_text(
      "nodes: {a: {position: [0, 0, 0]}, b: {position: [1, 0, 0]}}\nelements:\n  shaft: {type: beam, "
      "nodes: [a, b], elements: " +
      std::to_string(elements) + ", section: {" + section + "}" + more + "}\n");
}

/// Returns the unknowns `directions` of nodes 1 .. count, without `held`.
std::vector<int> unknowns(int count, const std::vector<int>& directions, const std::vector<int>& held) {
  std::vector<int> free;
  for (int node = 1; node <= count; ++node)
    for (int d : directions)
      if (std::find(held.begin(), held.end(), 6 * node + d) == held.end()) free.push_back(6 * node + d);
  return free;
}

const std::string steel = "rectangle: [0.02, 0.02], young: 210e9, poisson: 0.3, density: 7800";

/// Returns the relative errors of the first modes (columns) for 8, 16, 32, 64 elements (rows).
template <class Frequencies>
MatrixX error_table(const VectorX& exact, const Frequencies& computed) {
  MatrixX table(4, exact.size());
  for (int row = 0; row < 4; ++row)
    table.row(row) = (computed(8 << row).head(exact.size()).cwiseQuotient(exact).array() - 1).matrix().transpose();
  return table;
}

/// Returns the orders of convergence from row to row.
MatrixX orders(const MatrixX& errors) {
  return (errors.topRows(3).array() / errors.bottomRows(3).array()).abs().log() / std::log(2);
}

/// The bending is in the plane x-y. Either y at both ends and x at one are held, or all at one end.
const std::vector<int> pinned{6, 7, 13}, clamped{6, 7, 11};

VectorX plane_frequencies(int elements, const std::string& section, const std::vector<int>& held,
                          const std::string& more = "") {
  return frequencies(*unit_beam(elements, section, more), unknowns(elements + 1, {0, 1, 5}, held));
}

/// Returns the frequencies of a pinned Timoshenko beam of length 1: for q = n pi the lower root of
///     m J omega^4/S - (m B q^2/S + m + J q^2) omega^2 + B q^4 = 0      (bending B, shear S, mass m, rotary inertia J)
VectorX pinned_timoshenko(double B, double S, double m, double J) {
  VectorX omega(3);
  for (int n = 1; n <= 3; ++n) {
    const double q2 = n * n * pi * pi, a = m * J / S, b = m * B * q2 / S + m + J * q2, c = B * q2 * q2;
    omega[n - 1] = std::sqrt(2 * c / (b + std::sqrt(b * b - 4 * a * c)));
  }
  return omega;
}

/// Returns the first three of the steel bar of 1 m and 20 mm x 20 mm, tests/references/timoshenko_beam.py. @param ends
/// clamped, pinned
Vector3 steel_bar(const std::string& ends) {
  const bielle::test::ReferenceTable table("timoshenko_beam");
  const std::string name = "slender." + ends;
  return {table(name + "_1"), table(name + "_2"), table(name + "_3")};
}

}  // namespace

TEST_CASE("bending frequencies of slender beams converge with the fourth power of the element length") {
  // The radius of gyration is 1e-4 of the length: shear and rotary inertia change the frequency by 1e-6 at most.
  const std::string slender =
      "EA: 1e8, GAy: 3e7, GAz: 3e7, GJ: 1, EIy: 1, EIz: 1, mass_per_length: 1, Jx: 2e-8, Jy: 1e-8, Jz: 1e-8";
  const MatrixX errors =
      error_table(pinned_timoshenko(1, 3e7, 1, 1e-8), [&](int n) { return plane_frequencies(n, slender, pinned); });
  CAPTURE(errors, orders(errors));
  CHECK(orders(errors).topRows(2).minCoeff() > 3.7);
  // The error of the first mode reaches rounding at 64 elements.
  CHECK(orders(errors).rightCols(2).bottomRows(2).minCoeff() > 3.9);
  CHECK(orders(errors).topRows(2).maxCoeff() < 4.1);
}

TEST_CASE("bending frequencies of a steel bar are those of Timoshenko's theory") {
  const double E = 210e9, A = 4e-4, I = A * A / 12, rho = 7800;
  const VectorX exact = pinned_timoshenko(E * I, 5.0 / 6 * E / 2.6 * A, rho * A, rho * I);
  CHECK((exact - steel_bar("pinned")).cwiseAbs().maxCoeff() < 1e-5);
  MatrixX errors = error_table(exact, [](int n) { return plane_frequencies(n, steel, pinned); });
  // Besides the fourth order of a slender beam (which shear and rotary inertia change little) there is the part that
  // beam_inertia.hpp states, with E/(k_s G) = 3.12.
  const MatrixX slender = error_table(pinned_timoshenko(1, 3e7, 1, 1e-8), [&](int n) {
    return plane_frequencies(
        n, "EA: 1e8, GAy: 3e7, GAz: 3e7, GJ: 1, EIy: 1, EIz: 1, mass_per_length: 1, Jx: 2e-8, Jy: 1e-8, Jz: 1e-8",
        pinned);
  });
  for (int mode = 0; mode < 3; ++mode) {
    const double q = (mode + 1) * pi, qh = q / 32;
    CHECK_THAT(errors(2, mode) - slender(2, mode), Catch::WithinRel(3.12 * q * q * I / A * qh * qh / 24, 0.05));
  }
  // An independent program (without the mass m L/12) at 8 elements: 5.6e-5, 8.7e-4, 4.2e-3.
  CHECK(errors(0, 0) < 5.65e-5);
  CHECK(errors(0, 1) < 8.75e-4);
  CHECK(errors(0, 2) < 4.25e-3);

  // The beam is clamped; an independent program has 7.1e-6, 2.7e-4, 2.1e-3 at 8 elements.
  errors = error_table(steel_bar("clamped"), [](int n) { return plane_frequencies(n, steel, clamped); });
  CAPTURE(errors);
  CHECK(errors(0, 0) < 7.5e-6);
  CHECK(errors(0, 1) < 2.7e-4);
  CHECK(errors(0, 2) < 2.1e-3);
}

TEST_CASE("axial and torsional frequencies converge with the fourth power of the element length") {
  // Fixed-free: omega_n = (2n-1) pi/2 c, c^2 = EA/m and GJ/J_x.
  const std::string section =
      "EA: 4, GAy: 1, GAz: 1, GJ: 9, EIy: 1, EIz: 1, mass_per_length: 1, Jx: 1, Jy: 0.5, Jz: 0.5";
  for (int direction : {0, 3}) {
    const double c = direction == 0 ? 2 : 3;
    const VectorX exact = c * pi / 2 * Vector3(1, 3, 5);
    const MatrixX errors = error_table(exact, [&](int n) {
      return frequencies(*unit_beam(n, section), unknowns(n + 1, {direction}, {6 + direction}));
    });
    CAPTURE(direction, errors);
    CHECK(orders(errors).minCoeff() > 3.7);
    CHECK(orders(errors).bottomRows(2).minCoeff() > 3.9);
    CHECK(orders(errors).maxCoeff() < 4.1);
  }
}

TEST_CASE("constant strain leaves bending frequencies at the second power") {
  const VectorX exact = steel_bar("pinned");
  const MatrixX errors =
      error_table(exact, [](int n) { return plane_frequencies(n, steel, pinned, ", bending: constant"); });
  CAPTURE(errors, orders(errors));
  CHECK((orders(errors).array() - 2).abs().maxCoeff() < 0.15);
  // An independent program with lumped rotary inertia has 6.5e-3 2.6e-2 6.0e-2.
  CHECK_THAT(errors(0, 0), Catch::WithinAbs(6.5e-3, 0.1e-3));
  CHECK_THAT(errors(0, 1), Catch::WithinAbs(2.6e-2, 0.1e-2));
  CHECK_THAT(errors(0, 2), Catch::WithinAbs(6.0e-2, 0.2e-2));
}

TEST_CASE("mass, centre and inertia of a beam") {
  // A straight beam with offset, spun as a rigid body: exact.
  const auto straight = unit_beam(3, "circle: 0.1, young: 1, poisson: 0, density: 100, offset: [0.2, -0.3]");
  const DenseModel dense(*straight);
  const State state = dense.start();
  const MatrixX M = dense.tangent(state, Part::M);
  MatrixX rigid(dense.size(), 6);
  rigid.setZero();
  for (int k = 1; k < dense.nodes(); ++k) {
    rigid.block<3, 3>(6 * k, 0).setIdentity();
    rigid.block<3, 3>(6 * k, 3) = -skew(state.nodes[static_cast<std::size_t>(k)].x);
    rigid.block<3, 3>(6 * k + 3, 3).setIdentity();  // section frames are parallel to the inertial axes
  }
  const MatrixX body = rigid.transpose() * M * rigid;
  const double mass = pi;  // 100 * pi * 0.01 * 1
  const Vector3 centre(0.5, 0.2, -0.3);
  const Matrix3 rotary = mass * 0.01 / 4 * Vector3(2, 1, 1).asDiagonal().toDenseMatrix() +
                         mass / 12 * Vector3(0, 1, 1).asDiagonal().toDenseMatrix();
  MatrixX expected(6, 6);
  expected << mass * Matrix3::Identity(), -mass * skew(centre), mass * skew(centre),
      rotary - mass * skew(centre) * skew(centre);
  CHECK((body - expected).cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("a beam of unsymmetric section turns like the solids that it is made of") {
  // The section is an l with legs 0.5 x 0.1 along y and 0.1 x 0.3 along z on top of it; its centroid lies on the line
  // of the nodes.
  const double A = 0.05 + 0.03, y = (0.05 * 0.25 + 0.03 * 0.05) / A, z = (0.05 * 0.05 + 0.03 * 0.25) / A;
  const MassProperties leg_y = placed({Vector3(0.5, 0.25 - y, 0.05 - z), Matrix3::Identity()}, box({1, 0.5, 0.1})),
                       leg_z = placed({Vector3(0.5, 0.05 - y, 0.25 - z), Matrix3::Identity()}, box({1, 0.1, 0.3}));
  const Matrix3 expected = (leg_y + leg_z).inertia_about_origin();
  const auto beam = unit_beam(2, "l: {width: 0.5, height: 0.4, thickness: 0.1}, young: 1, shear: 1, density: 1");
  const DenseModel dense(*beam);
  State state = dense.start();
  const auto kinetic = [&](const Vector3& omega) {
    for (NodeState& n : state.nodes) {
      n.v = omega.cross(n.x);
      n.Omega = n.R.transpose() * omega;
    }
    return dense.energy(state).kinetic;
  };
  Random random(4);
  for (int k = 0; k < 6; ++k) {
    const Vector3 omega = random.vector3();
    CHECK_THAT(kinetic(omega), Catch::WithinRel(0.5 * omega.dot(expected * omega), 1e-12));
  }
}

TEST_CASE("the inertia of curved and twisted beams beside the node line converges with the fourth power") {
  // A turning beam as points along its line of mass centres, section axes turning with the line; rotary inertia 1e-12.
  for (const bool curved : {true, false}) {
    const Vector3 offset(0, 0.15, -0.2), omega(0.5, -0.7, 0.4);
    const double turn = curved ? pi / 2 : 2.0;
    const auto rate = [&](double s) {
      const Matrix3 R = exp_so3(curved ? Vector3(0, 0, -s * turn) : Vector3(s * turn, 0, 0));
      const Vector3 line = curved ? Vector3(std::sin(s * turn), std::cos(s * turn), 0) : Vector3(2 * s, 0, 0);
      return omega.cross(line + R * offset).squaredNorm();
    };
    double exact = 0;
    constexpr int parts = 1000;
    for (int k = 0; k < parts; ++k)
      exact += (rate(k / 1000.0) + 4 * rate((k + 0.5) / parts) + rate((k + 1.0) / parts)) / 6 / parts;
    exact *= 0.5 * (curved ? pi / 2 : 2);
    std::vector<double> errors;
    for (const int elements : {2, 4, 8, 16}) {
      const auto model = model_from_text(
          "nodes: {a: {position: " + std::string(curved ? "[0, 1, 0]" : "[0, 0, 0]") + "}, b: {position: " +
          (curved ? "[1, 0, 0]" : "[2, 0, 0]") + "}}\nelements:\n  b: {type: beam, nodes: [a, b], " +
          (curved ? "arc_centre: [0, 0, 0], orientation: [0, 1, 0]" : "twist: 2, orientation: [0, 1, 0]") +
          ", elements: " + std::to_string(elements) +
          ", section: {EA: 1, GAy: 1, GAz: 1, GJ: 1, EIy: 1, EIz: 1, mass_per_length: 1, Jx: 1e-12, Jy: 1e-12, Jz: "
          "1e-12, offset: [0.15, -0.2]}}\n");
      const DenseModel dense(*model);
      State state = dense.start();
      for (NodeState& n : state.nodes) {
        n.v = omega.cross(n.x);
        n.Omega = n.R.transpose() * omega;
      }
      errors.push_back(std::abs(dense.energy(state).kinetic / exact - 1));
    }
    CAPTURE(curved, errors);
    CHECK(errors[3] < 1e-5);
    for (std::size_t k = 2; k < 4; ++k) CHECK_THAT(std::log2(errors[k - 1] / errors[k]), Catch::WithinAbs(4, 0.15));
  }
}

TEST_CASE(
    "frequencies of a slender twisted arc beside its nodes converge with the fourth power of the element length") {
  const auto modes = [](int elements) {
    const auto model = model_from_text(
        "nodes: {a: {position: [1, 0, 0]}, b: {position: [0, 1, 0]}}\nelements:\n  arc: {type: beam, nodes: [a, b], "
        "arc_centre: [0, 0, 0], twist: 1, elements: " +
        std::to_string(elements) +
        ", section: {rectangle: [0.002, 0.003], young: 1e6, poisson: 0.3, density: 1, offset: [0.05, 0.03]}}\n");
    return VectorX(frequencies(*model, unknowns(elements + 1, {0, 1, 2, 3, 4, 5}, {6, 7, 8, 9, 10, 11})).head(3));
  };
  std::vector<VectorX> f;
  for (const int elements : {4, 8, 16, 32}) f.push_back(modes(elements));
  for (int mode = 0; mode < 3; ++mode) {
    CAPTURE(mode, f[0][mode], f[1][mode], f[2][mode], f[3][mode]);
    const double coarse = f[0][mode] - f[1][mode], fine = f[1][mode] - f[2][mode], finest = f[2][mode] - f[3][mode];
    CHECK(std::log2(std::abs(coarse / fine)) > 3.3);
    CHECK(std::log2(std::abs(fine / finest)) > 3.8);
  }
}

TEST_CASE("the polar inertia of a quarter circle converges with the fourth power of the element length") {
  // The inertia is m R^2 (pi/2) about its centre for a line of mass m per length; rotary inertia is 1e-12 of it.
  std::vector<double> errors;
  for (int elements : {2, 4, 8, 16}) {
    const auto model = model_from_text(
        "nodes: {a: {position: [1, 0, 0]}, b: {position: [0, 1, 0]}}\nelements:\n  arc: {type: beam, nodes: [a, b], "
        "arc_centre: [0, 0, 0], elements: " +
        std::to_string(elements) +
        ", section: {EA: 1, GAy: 1, GAz: 1, GJ: 1, EIy: 1, EIz: 1, mass_per_length: 1, Jx: 1e-12, Jy: 1e-12, Jz: "
        "1e-12}}\n");
    const DenseModel dense(*model);
    State state = dense.start();
    const Vector3 omega(0, 0, 1);
    for (NodeState& n : state.nodes) {
      n.v = omega.cross(n.x);
      n.Omega = n.R.transpose() * omega;
    }
    errors.push_back(2 * dense.energy(state).kinetic / (pi / 2) - 1);
  }
  CAPTURE(errors);
  // An independent program (without the mass m L/12, which changes the sixth order) has -2.1e-3 -1.3e-4 -8.2e-6
  // -5.2e-7.
  CHECK_THAT(errors[1], Catch::WithinAbs(-1.3e-4, 0.06e-4));
  CHECK_THAT(errors[2], Catch::WithinAbs(-8.2e-6, 0.06e-6));
  CHECK_THAT(errors[3], Catch::WithinAbs(-5.2e-7, 0.06e-7));
  for (std::size_t k = 2; k < 4; ++k) CHECK_THAT(std::log2(errors[k - 1] / errors[k]), Catch::WithinAbs(4, 0.1));
}

TEST_CASE("a free beam conserves energy, momentum and angular momentum at any state") {
  const auto model = model_from_text(R"(
nodes: {a: {position: [0.3, 0, 0], rotation_vector: [1, 0, 2]}, b: {position: [1, 1.5, 0.4], rotation_vector: [0, 0.4, 0]}}
elements:
  arc:
    {type: beam, nodes: [a, b], elements: 3, arc_through: [1, 0.2, 0.1], twist: 0.7, section: {rectangle: [0.3, 0.2], young: 50, poisson: 0.2, density: 30, offset: [0.1, -0.2]}}
)");
  const DenseModel dense(*model);
  const int n = 6 * (dense.nodes() - 1);
  for (unsigned seed : {1U, 2U, 3U}) {
    Random random(seed);
    State state = dense.start();
    dense.move(state, 0.3 * random.vector(dense.size()));
    dense.move_rates(state, random.vector(dense.size(), 2));
    // Accelerations of free flight: M a = -(the rest).
    const MatrixX M = dense.tangent(state, Part::M).bottomRightCorner(n, n);
    VectorX a = VectorX::Zero(dense.size());
    a.tail(n) = -bielle::solve_symmetric(M, dense.residual(state).tail(n));
    dense.move_accelerations(state, a);
    REQUIRE(dense.residual(state).tail(n).norm() < 1e-11);

    // T = v^T M v/2: momenta are sums of p = M v over the nodes.
    const auto invariants = [&](double s) -> Eigen::Matrix<double, 7, 1> {
      const State later = dense.along_motion(state, s);
      const VectorX p = dense.tangent(later, Part::M) * dense.rates(later);
      Vector3 P = Vector3::Zero(), L = Vector3::Zero();
      for (int k = 0; k < dense.nodes(); ++k) {
        const NodeState& node = later.nodes[static_cast<std::size_t>(k)];
        P += p.segment<3>(6 * k);
        L += node.x.cross(p.segment<3>(6 * k)) + node.R * p.segment<3>(6 * k + 3);
      }
      const Energy energy = dense.energy(later);
      Eigen::Matrix<double, 7, 1> all;
      all << energy.kinetic + energy.elastic, P, L;
      return all;
    };
    const Eigen::Matrix<double, 7, 1> size = invariants(0), rate = bielle::test::derivative(invariants, 0.005);
    CAPTURE(seed, size.transpose(), rate.transpose());
    CHECK(rate.cwiseAbs().maxCoeff() < 1e-10 * size.cwiseAbs().maxCoeff());
  }
}
