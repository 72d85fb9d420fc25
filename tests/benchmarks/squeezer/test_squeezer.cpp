// Andrews' squeezing mechanism: seven bodies in a plane, three loops, a spring, driven by a torque of 0.033 N m from
// rest. Data: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II (1996), section VII.7; Test Set for IVP
// Solvers (Bari/CWI), problem "andrews"; IFToMM library, case A03. Reference: Cartesian coordinates of the seven bodies
// (tests/references/squeezer.py). (The values published with the test set are right to 1e-10.)
//
// Angles of the source: the crank 1 stands at beta, bar 2 at beta + theta + pi from the crank's end P to F. Triangle 3
// turns by gamma about B, bars 4 and 5 lead from F over G to A (phi, delta), bars 6 and 7 over H to A (Omega, epsilon).
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/reference_table.hpp"
#include "tests/support/run_model.hpp"
#include "tests/support/second_order.hpp"

using namespace bielle::mechanism;
using bielle::test::check_second_order;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

struct Angles {
  double beta, theta, gamma, phi, delta, Omega, epsilon;
};

// At rest; theta = 0 up to the digits of beta.
const Angles start{
    -0.0617138900142764496, 0, 0.455279819163070380, 0.222668390165885885, 0.487364979543842550, -0.222668390165885885,
    1.23054744454982119};

Angles at_30_ms() {
  const bielle::test::ReferenceTable exact("squeezer");
  const auto angle = [&](const char* name) { return exact(std::string("at_30_ms.") + name); };
  return {angle("beta"),  angle("theta"), angle("gamma"),  angle("phi"),
          angle("delta"), angle("Omega"), angle("epsilon")};
}

/// Returns the direction at an angle from the inertial x axis.
Vector3 along(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

std::string node(const std::string& name, const Vector3& x, double angle) {
  return fmt::format("  {}: {{position: [{:.17g}, {:.17g}, 0], rotation_vector: [0, 0, {:.17g}]}}\n", name, x.x(),
                     x.y(), angle);
}

std::string body(const std::string& name, double mass, double inertia, double cx, double cy) {
  return fmt::format("  {}: {{type: rigid_body, node: {}, mass: {}, centre: [{}, {}, 0], inertia: [{}, {}, {}]}}\n",
                     name, name, mass, cx, cy, inertia, inertia, inertia);
}

std::string hinge(const std::string& name, const std::string& first, const std::string& second, const Vector3& at) {
  return fmt::format("  {}: {{type: hinge, nodes: [{}, {}], axis: [0, 0, 1], position: [{:.17g}, {:.17g}, 0]}}\n", name,
                     first, second, at.x(), at.y());
}

/// Each body's node stands at the joint that it turns about, x along the body.
std::string squeezer() {
  const Vector3 A(-0.06934, -0.00227, 0), B(-0.03635, 0.03273, 0), C(0.014, 0.072, 0), O(0, 0, 0);
  const auto& [beta, theta, gamma, phi, delta, Omega, epsilon] = start;
  const double quarter = M_PI / 2;
  const Vector3 P = 0.007 * along(beta), F = P - 0.028 * along(beta + theta);
  const Vector3 G = A + 0.04 * along(delta), H = A + 0.04 * along(epsilon - quarter);
  std::string text = "nodes:\n";
  text += node("k1", O, beta) + node("k2", P, beta + theta + M_PI) + node("k3", B, gamma - quarter);
  text += node("k4", G, phi + delta - quarter) + node("k5", A, delta);
  text += node("k6", H, Omega + epsilon) + node("k7", A, epsilon - quarter);
  text += "elements:\n";
  text += body("k1", 0.04325, 2.194e-6, 0.00092, 0) + body("k2", 0.00365, 4.410e-7, 0.0115, 0);
  text += body("k3", 0.02373, 5.255e-6, 0.01874, 0.01043) + body("k4", 0.00706, 5.667e-7, 0.02 - 0.01421, 0);
  text += body("k5", 0.07050, 1.169e-5, 0.02308, 0.00916) + body("k6", 0.00706, 5.667e-7, 0.02 - 0.01421, 0);
  text += body("k7", 0.05498, 1.912e-5, 0.01228, 0.00449);
  // The spring's end on the triangle: (sd cos g + sc sin g, sd sin g - sc cos g) = sc x + sd y of its axes.
  text += fmt::format(
      "  spring: {{type: spring_damper, nodes: [ground, k3], at: [[{}, {}, 0], [0.018, 0.02, 0]], stiffness: 4530, "
      "length: "
      "0.07785}}\n",
      C.x(), C.y());
  text += "joints:\n";
  text += hinge("main", "ground", "k1", O) + hinge("p", "k1", "k2", P) + hinge("f3", "k2", "k3", F);
  text += hinge("b", "ground", "k3", B) + hinge("f4", "k2", "k4", F) + hinge("g", "k4", "k5", G);
  text += hinge("a5", "ground", "k5", A) + hinge("f6", "k2", "k6", F) + hinge("h", "k6", "k7", H);
  text += hinge("a7", "ground", "k7", A);
  return text + "drives: {motor: {joint: main, torque: 0.033}}\n";
}

}  // namespace

TEST_CASE("the squeezing mechanism starts with the accelerations of the source") {
  const ReadyModel model(squeezer());
  const TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8),
                                    model.system.start(0));
  const State& state = integration.state();
  const bielle::test::ReferenceTable exact("squeezer");
  const double beta = model.node(state, "k1").Omegadot.z(), both = model.node(state, "k2").Omegadot.z();
  CHECK(integration.start_report().largest_displacement < 1e-12);
  CHECK(beta == Approx(exact("start.beta")).epsilon(1e-9));
  CHECK(both - beta == Approx(exact("start.theta")).epsilon(1e-9));
  for (const char* still : {"k3", "k4", "k5", "k6", "k7"})
    CHECK(std::abs(model.node(state, still).Omegadot.z()) < 1e-6 * beta);
}

TEST_CASE("the squeezing mechanism converges with order 2 to its equations of motion") {
  const ReadyModel model(squeezer());
  const auto& [beta, theta, gamma, phi, delta, Omega, epsilon] = at_30_ms();
  const double quarter = M_PI / 2;
  const std::pair<const char*, double> bodies[] = {
      {"k1", beta},  {"k2", beta + theta + M_PI}, {"k3", gamma - quarter},  {"k4", phi + delta - quarter},
      {"k5", delta}, {"k6", Omega + epsilon},     {"k7", epsilon - quarter}};
  const auto error = [&](double h) -> VectorX {
    const State state = integrate(model, Scheme::generalized_alpha(0.8), h, 0.03);
    VectorX e(14);
    for (int k = 0; k < 7; ++k)
      e.segment<2>(2 * k) = (model.node(state, bodies[k].first).R.col(0) - along(bodies[k].second)).head<2>();
    return e;
  };
  // The crank turns with up to 1100 rad/s, 0.011 rad in the longest step.
  check_second_order(error, 1e-5, 2, 0.2, 0.2);
}
