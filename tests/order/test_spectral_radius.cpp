// Spectral radii of the schemes, measured on motions that the program computes, against theory.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "reduce/dense/dense_solves.hpp"
#include "tests/support/eigenvalues.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::ReadyModel;

namespace {

/// Returns an oscillator of 1 kg with omega = 1/s, without start correction of A, so that the parasitic root takes
/// part. The state of the recurrence is (q_n, h v_n, q_{n+1}), or (q_n, h v_n) if A_n = a_n: consecutive states give
/// its matrix.
double oscillator_radius(const Scheme& scheme, double omega_h) {
  const ReadyModel model(R"yaml(
nodes: {m: {position: [0.2, 0, 0], velocity: ["0.1/h", 0, 0], fixed: [y, z, rx, ry, rz]}}
elements:
  m: {type: point_mass, node: m, mass: 1}
  s: {type: spring_damper, nodes: [ground, m], stiffness: 1, length: 0}
parameters: {h: )yaml" + std::to_string(omega_h) +
                         "}\n");
  TimeIntegration integration(model.system, model.environment(), scheme, model.system.start(0));
  const Eigen::Index n = scheme.alpha_f == 0 && scheme.alpha_m == 0 ? 2 : 3;
  std::vector<Vector3> states;  // the third component follows one step later
  while (true) {
    const NodeState& m = model.node(integration.state(), "m");
    const double q = m.x.x();
    if (!states.empty()) states.back().z() = q;
    if (static_cast<Eigen::Index>(states.size()) > n) break;
    states.emplace_back(q, omega_h * m.v.x(), 0);
    integration.step(omega_h);
  }
  MatrixX before(n, n), after(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    before.col(k) = states[static_cast<std::size_t>(k)].head(n);
    after.col(k) = states[static_cast<std::size_t>(k) + 1].head(n);
  }
  return bielle::test::eigenvalues(after * bielle::regular_inverse(before).value()).cwiseAbs().maxCoeff();
}

/// Returns the errors of the multiplier of a mass that is driven along x = t^3/6, exact force m t: started without
/// correction, they show the scheme's response to a disturbance along a constraint.
std::vector<double> driven_errors(const Scheme& scheme, int steps) {
  const ReadyModel model(R"yaml(
nodes: {m: {position: [0, 0, 0]}}
elements: {m: {type: rigid_body, node: m, mass: 1, inertia: [1, 1, 1]}}
joints: {guide: {type: prismatic, nodes: [ground, m], axis: [1, 0, 0]}}
drives: {push: {joint: guide, displacement: "t^3/6"}}
)yaml");
  TimeIntegration integration(model.system, model.environment(), scheme, model.system.start(0),
                              ConstraintForm::position);
  std::vector<double> errors;
  for (int k = 0; k < steps; ++k) {
    integration.step(1e-2);
    const double t = integration.state().time;
    errors.push_back(integration.state().multiplier.tail<1>()[0] + t);
  }
  return errors;
}

}  // namespace

TEST_CASE("the spectral radius of an oscillator is that of theory") {
  // Eigenvalues of the amplification matrices (J. Chung, G. M. Hulbert, J. Appl. Mech. 60 (1993) 371; H. M. Hilber, T.
  // J. R. Hughes, R. L. Taylor 1977), computed from the schemes' definitions to all digits shown.
  struct Row {
    const char* name;
    Scheme scheme;
    std::array<double, 5> radius;
  };
  const std::array<double, 5> omega_h = {0.1, 1, 3, 10, 100};
  const Row rows[] = {
      {"HHT, rho = 0.9", Scheme::hht(0.1 / 1.9), {.99999941, .99633035, .95574067, .90891038, .90009638}},
      {"rho = 0.9", Scheme::generalized_alpha(0.9), {.99999999, .99994226, .99831756, .98376308, .92844867}},
      {"rho = 0.8", Scheme::generalized_alpha(0.8), {.99999993, .99947461, .98726582, .92979177, .83463761}},
      {"rho = 0.5", Scheme::generalized_alpha(0.5), {.99999816, .98931279, .87613288, .68252842, .53717362}},
      {"Newmark", Scheme::newmark(), {1, 1, 1, 1, 1}},
  };
  for (const Row& row : rows)
    for (std::size_t k = 0; k < omega_h.size(); ++k) {
      INFO(row.name << ", omega h = " << omega_h[k]);
      CHECK(oscillator_radius(row.scheme, omega_h[k]) == Approx(row.radius[k]).margin(2e-8));
    }
}

TEST_CASE("the spectral radius at infinite frequency is rho") {
  for (const double rho : {0.3, 0.6, 0.8, 0.95}) {
    INFO("rho = " << rho);
    // The triple root at infinity opens with (omega h)^(-2/3): 0.04 at 100, 0.008 at 1000.
    const double near = oscillator_radius(Scheme::generalized_alpha(rho), 100) - rho;
    const double far = oscillator_radius(Scheme::generalized_alpha(rho), 1000) - rho;
    CHECK(far < 0.02);
    CHECK(near / far == Approx(std::pow(10, 2.0 / 3)).epsilon(0.2));
  }
}

TEST_CASE("a disturbance along a constraint decays with the roots of the index-3 equations") {
  // Roots {0, x, x, -alpha_f/(1 - alpha_f)} with x = (2 gamma - 3)/(2 gamma + 1) (A. Cardona, M. Geradin, Comput.
  // Struct. 33 (1989) 801): errors annihilated by (E - x)^2 (E + alpha_f/(1 - alpha_f)), E the shift by a step. For
  // generalised-alpha that is (E + rho)^3; for Newmark x = -1 twice: they do not decay at all.
  for (const Scheme& scheme : {Scheme::generalized_alpha(0.9), Scheme::generalized_alpha(0.6), Scheme::hht(0.1 / 1.9),
                               Scheme::hht(0.2), Scheme::newmark()}) {
    const double x = (2 * scheme.gamma - 3) / (2 * scheme.gamma + 1), y = -scheme.alpha_f / (1 - scheme.alpha_f);
    const std::vector<double> e = driven_errors(scheme, 12);
    INFO("alpha_m = " << scheme.alpha_m << ", alpha_f = " << scheme.alpha_f << ", first error " << e[0]);
    CHECK(std::abs(e[0]) > 1e-4);
    for (std::size_t k = 1; k + 3 < e.size(); ++k) {
      const double rest = e[k + 3] - (2 * x + y) * e[k + 2] + (x * x + 2 * x * y) * e[k + 1] - x * x * y * e[k];
      CHECK(std::abs(rest) < 1e-8 * std::abs(e[0]));
    }
  }
  // Newmark's double root has only one eigenvector: the error even grows, in proportion to the number of steps.
  const std::vector<double> newmark = driven_errors(Scheme::newmark(), 200);
  CHECK(newmark[199] / newmark[1] == Approx(100).epsilon(1e-6));
  CHECK(newmark[199] * newmark[198] < 0);
}
