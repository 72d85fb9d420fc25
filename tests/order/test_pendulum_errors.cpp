// The pendulum as an index-3 problem: m = 1 kg, L = 1 m, g = 9.81 m/s^2, released at rest from the horizontal. Errors
// at t = 1 s of another implementation (tests/references/index_three.py: two unknowns, one constraint (x^2 + y^2 -
// 1)/2, A_0 = a_0) against the closed form. The body's rotation, which that implementation does not have, carries no
// inertia here and changes nothing.
#include <catch2/catch.hpp>

#include "tests/support/reference_table.hpp"
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
  // There is no start(h): A_0 = a_0, and the velocity stays unchanged.
  for (long k = 0; k < std::lround(1 / h); ++k) integration.step(h);
  const State& state = integration.state();
  const NodeState& bob = model.node(state, "bob");
  // tests/references/simple_pendulum.py, from the other side; speed and tension 3 m g |y| by conservation of energy.
  const Eigen::Vector2d exact = bielle::test::ReferenceTable("simple_pendulum").plane("1");
  const Vector3 x(-exact.x(), exact.y(), 0);
  const double speed = std::sqrt(2 * 9.81 * -x.y()), tension = 3 * 9.81 * -x.y();
  // On its first way to the other side, the bob moves along (y, -x).
  const Vector3 v = speed * Vector3(x.y(), -x.x(), 0);
  return {(bob.x - x).norm(), (bob.v - v).norm(), std::abs(state.multiplier.head<3>().norm() - tension)};
}

}  // namespace

TEST_CASE("the pendulum's errors are those of an independent implementation, scheme by scheme, of order 2") {
  struct Row {
    const char* name;
    Scheme scheme;
  };
  const Row rows[] = {{"newmark", Scheme::newmark()},
                      {"hht", Scheme::hht(0.1 / 1.9)},
                      {"rho_0.9", Scheme::generalized_alpha(0.9)},
                      {"rho_0.8", Scheme::generalized_alpha(0.8)},
                      {"rho_0.5", Scheme::generalized_alpha(0.5)}};
  const bielle::test::ReferenceTable table("index_three");
  for (const Row& row : rows)
    for (const auto& [h, step] : {std::pair(0.01, "0.01"), std::pair(0.0025, "0.0025")}) {
      const Errors found = errors_at_one_second(row.scheme, h);
      const std::string name = std::string("pendulum.") + row.name + "." + step + ".";
      INFO(row.name << ", h = " << h);
      // Newmark's multipliers contain the remainder of Newton's method, amplified (weak instability): with tolerances
      // from 1e-6 to 1e-12 the other implementation itself gives 3.584e-3 to 3.587e-3.
      CHECK(found.q == Approx(table(name + "q")).epsilon(2e-4));
      CHECK(found.v == Approx(table(name + "v")).epsilon(2e-4));
      CHECK(found.lambda == Approx(table(name + "lambda")).epsilon(&row == rows ? 3e-3 : 2e-4));
    }
}

}  // namespace test_pendulum_errors
