// The pendulum as an index-3 problem: m = 1 kg, L = 1 m, g = 9.81 m/s^2, released at rest from the horizontal. Errors
// at t = 1 s of an independent implementation in Python (two unknowns, one constraint (x^2 + y^2 - 1)/2, A_0 = a_0)
// against the closed form. The body's rotation, which that implementation does not have, has no inertia here and
// changes nothing.
#include <catch2/catch.hpp>

#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::ReadyModel;

namespace test_pendulum_errors {
namespace {

struct Errors {
  double q, v, lambda;
};

Errors errors_at_one_second(const Scheme& scheme, double h) {
  const ReadyModel model(R"yaml(
gravity: [0, -9.81, 0]
nodes: {bob: {position: [1, 0, 0]}}
elements: {bob: {type: rigid_body, node: bob, mass: 1, inertia: [1e-12, 1e-12, 1e-12]}}
joints: {pivot: {type: hinge, nodes: [ground, bob], axis: [0, 0, 1], position: [0, 0, 0]}}
)yaml");
  TimeIntegration integration(model.system, model.environment(), scheme, model.system.start(0),
                              ConstraintForm::position);
  // Without start(h): with A_0 = a_0 and the velocity as it is.
  for (long k = 0; k < std::lround(1 / h); ++k) integration.step(h);
  const State& state = integration.state();
  const NodeState& bob = model.node(state, "bob");
  // Jacobi's elliptic functions, 30 digits; the speed and the tension 3 m g |y| by conservation of energy.
  const Vector3 x(-0.986291751131875, -0.165010853125541, 0);
  const double speed = std::sqrt(2 * 9.81 * 0.165010853125541), tension = 3 * 9.81 * 0.165010853125541;
  // On its first way to the other side it moves along (y, -x).
  const Vector3 v = speed * Vector3(x.y(), -x.x(), 0);
  return {(bob.x - x).norm(), (bob.v - v).norm(), std::abs(state.multiplier.head<3>().norm() - tension)};
}

}  // namespace

TEST_CASE("the pendulum's errors are those of an independent implementation, scheme by scheme, of order 2") {
  struct Row {
    const char* name;
    Scheme scheme;
    Errors coarse, fine;  // h = 0.01 and 0.0025
  };
  const Row rows[] = {
      {"Newmark", Scheme::newmark(), {5.8589e-4, 3.0979e-3, 5.7278e-2}, {3.6603e-5, 1.9387e-4, 3.5886e-3}},
      {"HHT, rho = 0.9", Scheme::hht(0.1 / 1.9), {6.7914e-4, 3.5380e-3, 1.3990e-2}, {4.2052e-5, 2.2200e-4, 8.7289e-4}},
      {"rho = 0.9",
       Scheme::generalized_alpha(0.9),
       {5.9330e-4, 3.1391e-3, 1.2264e-2},
       {3.7060e-5, 1.9630e-4, 7.7121e-4}},
      {"rho = 0.8",
       Scheme::generalized_alpha(0.8),
       {6.1941e-4, 3.2713e-3, 1.2878e-2},
       {3.8651e-5, 2.0464e-4, 8.0408e-4}},
      {"rho = 0.5",
       Scheme::generalized_alpha(0.5),
       {9.0413e-4, 4.6051e-3, 1.8376e-2},
       {5.5301e-5, 2.9028e-4, 1.1438e-3}},
  };
  for (const Row& row : rows)
    for (const auto& [h, expected] : {std::pair(0.01, row.coarse), std::pair(0.0025, row.fine)}) {
      const Errors found = errors_at_one_second(row.scheme, h);
      INFO(row.name << ", h = " << h);
      // The five digits of the table; but Newmark's multipliers carry what Newton's method left, amplified (weak
      // instability): with tolerances from 1e-6 to 1e-12 the independent implementation itself gives 3.584e-3
      // to 3.587e-3.
      CHECK(found.q == Approx(expected.q).epsilon(2e-4));
      CHECK(found.v == Approx(expected.v).epsilon(2e-4));
      CHECK(found.lambda == Approx(expected.lambda).epsilon(&row == rows ? 3e-3 : 2e-4));
    }
}

}  // namespace test_pendulum_errors
