// Beams of several elements at rest: patch tests, elastica, roll-up, the 45-degree bend.
#include <cmath>
#include <numeric>

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/elements/beam_element.hpp"
#include "tests/support/dense_model.hpp"
#include "tests/support/model_text.hpp"
#include "tests/support/random.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::model_from_text;
using bielle::test::Random;
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

TEST_CASE("a helix of constant strain that is an equilibrium of the rod is one of the elements (patch test)") {
  // A rod with strain eps carries f = C eps. With kappa = Kappa, gamma = e_x + Gamma, equilibrium without loads asks
  // for kappa x n = 0 and kappa x m + gamma x n = 0, hence n = alpha kappa, m = alpha gamma + beta kappa; C is made to
  // fit.
  Random random(1);
  Vector6 eps = 0.4 * random.vector(6);
  const Vector3 kappa = eps.tail<3>(), gamma = Vector3::UnitX() + eps.head<3>();
  Vector6 f;
  f << 0.7 * kappa, 0.7 * gamma + 4.0 * kappa;
  REQUIRE(f.dot(eps) > 0);
  const Matrix6 C0 = random.positive_matrix(6);
  const Vector6 g = C0 * eps;
  BeamSection section;
  section.stiffness = C0 - g * g.transpose() / eps.dot(g) + f * f.transpose() / eps.dot(f);
  REQUIRE((section.stiffness * eps - f).norm() < 1e-14);

  Model model;
  const std::vector<double> stations{0, 0.7, 1.0, 2.2, 2.5};  // elements of unequal length
  std::vector<int> nodes;
  for (double s : stations) {
    Node node;
    node.name = fmt::format("n{}", nodes.size());
    node.frame = exp_se3(s * (eps + Vector6::Unit(0)));
    nodes.push_back(model.add_node(node));
  }
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
    model.add(std::make_unique<BeamElement>("patch", BeamPlace{}, nodes[k], nodes[k + 1], Matrix3::Identity(),
                                            Matrix3::Identity(), (stations[k + 1] - stations[k]) * Vector6::Unit(0),
                                            section, 0.0, BeamBending::constant),
              "elements/patch", true);
  const DenseModel dense(model);
  const VectorX r = dense.residual(dense.start());
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) CHECK(r.segment<6>(6 * nodes[k]).norm() < 1e-13);
  CHECK((r.segment<6>(6 * nodes.front()) + f).norm() < 1e-13);  // the cut at the start, whose frame is the inertial one
}

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

TEST_CASE("three elements roll up to a full circle under an end moment, whatever their orientation") {
  // EI = 2, L = 3: M = 2 pi EI/L closes the circle. The beam lies in a general direction, its moment about its own axis
  // z.
  const Matrix3 R = exp_so3(Vector3(0.4, -0.7, 1.1));
  const Vector3 end = R.col(0) * 3, M = R.col(2) * 2 * pi * 2 / 3;
  const auto list = [](const Vector3& v) { return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z()); };
  for (const char* bending : {"residual", "constant"}) {
    Cantilever beam("nodes: {root: {position: [0, 0, 0]}, tip: {position: " + list(end) + "}}\n" +
                    "elements: {b: {type: beam, nodes: [root, tip], elements: 3, bending: " + bending +
                    ", orientation: " + list(R.col(1)) +
                    ", section: {EA: 1e4, GAy: 3e3, GAz: 3e3, GJ: 20, EIy: 20, EIz: 2}}}\n" +
                    "loads: {m: {node: tip, moment: " + list(M) + "}}\n");
    // The floor of the residual is EA epsilon |x|/L ~ 1e-12.
    beam.load(24, 1e-10);
    CHECK(beam.tip().x.norm() < 1e-12);
    CHECK((beam.tip().R - Matrix3::Identity()).norm() < 1e-12);
    // A third of the circle of radius L/(2 pi), whose centre lies on the section's y axis.
    const double radius = 3 / (2 * pi);
    const Vector3 expected = radius * (std::sin(2 * pi / 3) * R.col(0) + (1 - std::cos(2 * pi / 3)) * R.col(1));
    CHECK((beam.state.nodes[3].x - expected).norm() < 1e-12);
  }
}

TEST_CASE("the tip of the elastica converges with the square of the element length") {
  // L = 1, EI = 1, EA = 1200, GA = 5/6 EA/2.6, P = 1: by shooting to 1e-12 (Reissner's strains).
  const double x = 0.943133684318, y = 0.303973057238, theta = 0.461091000985;
  std::vector<double> errors;
  for (int elements : {2, 4, 8, 16}) {
    Cantilever beam(
        "nodes: {root: {position: [0, 0, 0]}, tip: {position: [1, 0, 0]}}\n"
        "elements: {b: {type: beam, nodes: [root, tip], elements: " +
        std::to_string(elements) +
        ", section: {EA: 1200, GAy: 1000/2.6, GAz: 1000/2.6, GJ: 1, EIy: 1, EIz: 1}}}\n"
        "loads: {p: {node: tip, force: [0, 1, 0]}}\n");
    beam.load(2, 1e-11);
    errors.push_back(std::hypot(beam.tip().x.x() - x, beam.tip().x.y() - y, log_so3(beam.tip().R).z() - theta));
  }
  for (std::size_t k = 1; k < errors.size(); ++k) {
    CAPTURE(errors[k - 1], errors[k]);
    CHECK(std::log2(errors[k - 1] / errors[k]) > 1.9);
  }
  CHECK(errors.back() < 1e-4);
}

TEST_CASE("the 45-degree bend of Bathe and Bolourchi") {
  // K.-J. Bathe, S. Bolourchi, IJNME 14 (1979) 961. R = 100, 1x1, E = 1e7, G = 5e6, GJ = G/6; P = 600 at the tip along
  // z. Values of an independent program of the same element; the limit 15.6848 47.1504 53.4750 by shooting.
  struct Case {
    const char* bending;
    int elements;
    Vector3 tip;
  };
  for (const Case& c :
       {Case{"constant", 2, {16.1198, 48.5237, 51.1607}}, Case{"constant", 8, {15.7111, 47.2319, 53.3332}},
        Case{"residual", 2, {15.6339, 47.1989, 53.7544}}, Case{"residual", 8, {15.6841, 47.1494, 53.4830}}}) {
    CAPTURE(c.bending, c.elements);
    Cantilever beam(
        "nodes: {root: {position: [0, 0, 0]}, tip: {position: ['100 - 50*sqrt(2)', '50*sqrt(2)', 0]}}\n"
        "elements: {b: {type: beam, nodes: [root, tip], arc_centre: [100, 0, 0], bending: " +
        std::string(c.bending) + ", elements: " + std::to_string(c.elements) +
        ", section: {EA: 1e7, GAy: 5e6, GAz: 5e6, GJ: 5e6/6, EIy: 1e7/12, EIz: 1e7/12}}}\n"
        "loads: {p: {node: tip, force: [0, 0, 600]}}\n");
    beam.load(12, 1e-5);
    CHECK((beam.tip().x - c.tip).cwiseAbs().maxCoeff() < 6e-5);  // printed with four decimals
  }
}
