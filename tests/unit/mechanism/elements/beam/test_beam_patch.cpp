// States that a beam must represent exactly: constant strains on curved and twisted elements, rolling up, rigid
// rotation of a bent beam, and the way back.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/elements/beam/beam_element.hpp"
#include "tests/support/list_of_numbers.hpp"
#include "tests/support/random.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/static_model.hpp"

using namespace bielle::mechanism;
using bielle::test::DenseModel;
using bielle::test::list;
using bielle::test::Random;
using bielle::test::solve_static;
using bielle::test::StaticModel;
using std::numbers::pi;

namespace {

/// Four elements of unequal length, free of stress on the helix of tangent e_x and curvature `K0`, brought to the
/// strain eps. @returns the largest remaining force at their inner nodes, and the difference of the force in the first
/// element from `f`
double patch_error(const Vector3& K0, const Vector6& eps, const Matrix6& C, const Vector6& f, BeamBending bending) {
  Vector6 reference = Vector6::Unit(0);
  reference.tail<3>() = K0;
  BeamSection section;
  section.stiffness = C;
  Model model;
  const std::vector<double> stations{0, 0.7, 1.0, 2.2, 2.5};
  std::vector<int> nodes;
  for (double s : stations) {
    Node node;
    node.name = fmt::format("n{}", nodes.size());
    node.frame = exp_se3(s * (reference + eps));
    nodes.push_back(model.add_node(node));
  }
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
    model.add(std::make_unique<BeamElement>("patch", BeamPlace{}, nodes[k], nodes[k + 1], Matrix3::Identity(),
                                            Matrix3::Identity(), Vector6((stations[k + 1] - stations[k]) * reference),
                                            section, 0.0, bending),
              Entry{Section::elements, "patch"}, Recorded::stacked);
  const DenseModel dense(model);
  const VectorX r = dense.residual(dense.start());
  double error = (r.segment<6>(6 * nodes.front()) + f).norm();  // the section at the start has inertial axes
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) error = std::max(error, r.segment<6>(6 * nodes[k]).norm());
  return error;
}

/// Returns the nearest to C0 that makes f of eps, f.eps > 0.
Matrix6 fitted(const Matrix6& C0, const Vector6& eps, const Vector6& f) {
  const Vector6 g = C0 * eps;
  return C0 - g * g.transpose() / eps.dot(g) + f * f.transpose() / eps.dot(f);
}

}  // namespace

TEST_CASE("all six strains of a curved and twisted beam are exact with constant strain (patch test)") {
  // Equilibrium without loads of constant f = (n, m) in the section frame: kappa x n = 0, kappa x m + gamma x n = 0
  // with kappa = K0 + K and gamma = e_x + Gamma, hence n = alpha kappa, m = alpha gamma + beta kappa; C is made to fit.
  for (unsigned seed : {1U, 2U, 3U, 4U}) {
    Random random(seed);
    const Vector3 K0 = 0.4 * random.vector3();
    Vector6 eps = 0.3 * random.vector(6);
    const Vector3 kappa = K0 + eps.tail<3>(), gamma = Vector3::UnitX() + eps.head<3>();
    Vector6 f;
    f << 0.7 * kappa, 0.7 * gamma + 0.4 * kappa;
    if (f.dot(eps) < 0) f = -f;
    const Matrix6 C = fitted(random.positive_matrix(6), eps, f);
    CAPTURE(seed, K0.transpose(), eps.transpose());
    CHECK(patch_error(K0, eps, C, f, BeamBending::constant) < 2e-12);
  }
}

TEST_CASE(
    "stretch, bending and torsion of curved and twisted beams are exact with the residual flexibility (patch test)") {
  for (BeamBending bending : {BeamBending::residual, BeamBending::constant}) {
    Vector6 C, eps = Vector6::Zero();
    C << 5, 2, 3, 1.5, 4, 2.5;
    const auto error = [&](const Vector3& K0) {
      return patch_error(K0, eps, C.asDiagonal(), C.cwiseProduct(eps), bending);
    };
    // The arc is bent in its plane beyond the straight line, to the other side.
    eps[5] = -1.1;
    CHECK(error({0, 0, 0.5}) < 1e-13);
    eps[5] = 0;
    eps[4] = 0.4;
    CHECK(error({0, 0.5, 0}) < 1e-13);
    // A pre-twisted beam is stretched and twisted.
    eps.setZero();
    eps[0] = 0.2;
    eps[3] = 0.7;
    CHECK(error({-0.4, 0, 0}) < 1e-13);
    // A helix wound up and bent at once, in its own ratio of twist and curvature: m along kappa for GJ = EI.
    C.tail<3>().setConstant(2);
    const Vector3 K0(0.3, -0.2, 0.5);
    eps << Vector3::Zero(), 0.6 * K0;
    CHECK(error(K0) < 1e-13);
  }
}

TEST_CASE("a beam rolls up exactly: once with three elements, to two turns with five") {
  // EI = 2, L = 3, M = 2 pi turns EI/L, in a general direction about its own axis z.
  const Matrix3 R = exp_so3(Vector3(0.4, -0.7, 1.1));
  for (const auto& [elements, turns] : {std::pair{3, 1}, {5, 2}})
    for (const char* bending : {"residual", "constant"}) {
      CAPTURE(elements, turns, bending);
      StaticModel beam("nodes: {root: {position: [0, 0, 0], fixed: true}, tip: {position: " + list(3 * R.col(0)) +
                       "}}\n" + "elements: {b: {type: beam, nodes: [root, tip], elements: " + std::to_string(elements) +
                       ", bending: " + bending + ", orientation: " + list(R.col(1)) +
                       ", section: {EA: 1e4, GAy: 3e3, GAz: 3e3, GJ: 20, EIy: 20, EIz: 2}}}\n" +
                       "loads: {m: {node: tip, moment: " + list(R.col(2) * 2 * pi * turns * 2 / 3) + "}}\n");
      // The floor of the residual is EA epsilon |x|/L ~ 1e-12.
      REQUIRE(beam.load(24 * turns, 1e-10) >= 0);
      CHECK(beam.node("tip").x.norm() < 1e-12);
      CHECK((beam.node("tip").R - Matrix3::Identity()).norm() < 2e-12);
      // The first inner node on the circle of radius L/(2 pi turns) with its centre on the section's y.
      const double radius = 3 / (2 * pi * turns), angle = 2 * pi * turns / elements;
      const Vector3 expected = radius * (std::sin(angle) * R.col(0) + (1 - std::cos(angle)) * R.col(1));
      CHECK((beam.node("b.1").x - expected).norm() < 1e-12);
    }
}

namespace {

/// Returns a curved cantilever under two loads whose parts are switched by the parameter t.
std::string loaded_arc(bool follower) {
  return std::string(
             "nodes: {root: {position: [0, 0, 0], fixed: true}, tip: {position: [2, 1, 0]}}\n"
             "elements: {b: {type: beam, nodes: [root, tip], elements: 6, arc_through: [1, 0.9, 0.1], section: {EA: "
             "100, GAy: 50, GAz: 40, GJ: 1, EIy: 2, EIz: 1}}}\n"
             "loads:\n  p: {node: tip, force: ['ramp(t, 0, 1)', 0, 'ramp(t, 0, 1)'], follower: ") +
         (follower ? "true" : "false") +
         "}\n  m: {node: tip, moment: ['1.5*ramp(t, 1, 2)', 'ramp(t, 1, 2)', 0], follower: " +
         (follower ? "true" : "false") + "}\n";
}

/// Follows the loads from the present state to `end` in steps of t.
void follow(StaticModel& model, double end, int steps) {
  const double from = model.state.time;
  for (int k = 1; k <= steps; ++k) {
    model.state.time = from + (end - from) * k / steps;
    REQUIRE(solve_static(model.dense, model.state, model.free, 1e-12) >= 0);
  }
}

}  // namespace

TEST_CASE("a load cycle ends where it began, and what lies between does not matter (path independence)") {
  StaticModel beam(loaded_arc(false));
  const State start = beam.state;
  follow(beam, 2, 40);
  CHECK((beam.node("tip").x - Vector3(2, 1, 0)).norm() > 0.5);
  const NodeState loaded = beam.node("tip");
  // The same loads, increased together, lead to the same position by another path.
  StaticModel other(loaded_arc(false));
  other.state.time = 2;
  REQUIRE(other.load(60, 1e-12) >= 0);
  CHECK((other.node("tip").x - loaded.x).norm() < 1e-12);
  CHECK((other.node("tip").R - loaded.R).norm() < 1e-12);
  follow(beam, 0, 40);
  for (std::size_t k = 0; k < start.nodes.size(); ++k) {
    CHECK((beam.state.nodes[k].x - start.nodes[k].x).norm() < 1e-13);
    CHECK((beam.state.nodes[k].R - start.nodes[k].R).norm() < 1e-13);
  }
}

TEST_CASE("a bent beam that is carried around by its clamp keeps its strains (objectivity)") {
  StaticModel beam(loaded_arc(true));
  follow(beam, 2, 40);
  const double energy = beam.dense.energy(beam.state).elastic;
  const NodeState tip = beam.node("tip");
  const auto root = static_cast<std::size_t>(*beam.model->find_node("root"));
  // Only the clamp turns, by one and a half turns about a general axis: the rest follows by Newton's method.
  const Vector3 axis = Vector3(1, -2, 0.5).normalized();
  for (int k = 1; k <= 180; ++k) {
    beam.state.nodes[root].R = exp_so3(axis * (3 * pi * k / 180));
    beam.state.nodes[root].x = 0.003 * k * Vector3(1, 2, 3);
    REQUIRE(solve_static(beam.dense, beam.state, beam.free, 1e-11) >= 0);
  }
  const Matrix3 Q = exp_so3(axis * 3 * pi);
  CHECK(std::abs(beam.dense.energy(beam.state).elastic - energy) < 1e-12 * energy);
  CHECK((beam.node("tip").x - (beam.state.nodes[root].x + Q * tip.x)).norm() < 1e-11);
  CHECK((beam.node("tip").R - Q * tip.R).norm() < 1e-11);
}

TEST_CASE("a beam of slenderness 1e4 does not lock") {
  // L = EI = 1, P = 1: the inextensible elastica by shooting (tests/references/elastica.py), u, w, theta. The thinner
  // the beam, the nearer; 8 elements leave an error of second order which the thickness must not change.
  const bielle::test::ReferenceTable table("elastica");
  const Vector3 exact(1 - table("inextensible_1.shortening"), table("inextensible_1.deflection"),
                      table("inextensible_1.slope"));
  const auto error = [&](double slenderness) {
    const double EA = 12 * slenderness * slenderness;
    StaticModel beam(fmt::format(
        "nodes: {{root: {{position: [0, 0, 0], fixed: true}}, tip: {{position: [1, 0, 0]}}}}\n"
        "elements: {{b: {{type: beam, nodes: [root, tip], elements: 8, section: {{EA: {0}, GAy: {0}, GAz: {0}, GJ: 1, "
        "EIy: 1, EIz: 1}}}}}}\nloads: {{p: {{node: tip, force: [0, 1, 0]}}}}\n",
        EA));
    REQUIRE(beam.load(4, 1e-14 * EA + 1e-10) >= 0);
    return Vector3(Vector3(beam.node("tip").x.x(), beam.node("tip").x.y(), log_so3(beam.node("tip").R).z()) - exact);
  };
  const Vector3 thick = error(1e2), thin = error(1e3), thinnest = error(1e4);
  CAPTURE(thick.transpose(), thin.transpose(), thinnest.transpose());
  CHECK(thinnest.norm() < 1e-3);
  CHECK((thin - thinnest).norm() < 1e-4 * exact.norm());  // extension and shear: 1/(12e6)
  CHECK((thin - thinnest).norm() < 2 * (thick - thin).norm() / 90);
}
