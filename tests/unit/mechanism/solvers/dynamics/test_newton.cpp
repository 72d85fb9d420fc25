// Newton's method within a step: tangents that serve several iterations, shortened steps, reports.
#include <catch2/catch.hpp>

#include "mechanism/solvers/statics/statics.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::ReadyModel;

namespace test_newton {
namespace {

const char* const chain = R"yaml(
gravity: [0, 0, -9.81]
nodes: {a: {position: [0.5, 0, 0]}, b: {position: [1.5, 0, 0]}, c: {position: [2.5, 0, 0]}}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [1e-3, 1/12, 1/12]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [1e-3, 1/12, 1/12]}
  c: {type: rigid_body, node: c, mass: 1, inertia: [1e-3, 1/12, 1/12]}
joints:
  a: {type: spherical, nodes: [ground, a], position: [0, 0, 0]}
  b: {type: spherical, nodes: [a, b], position: [1, 0, 0]}
  c: {type: spherical, nodes: [b, c], position: [2, 0, 0]}
)yaml";

struct Course {
  State end;
  long iterations = 0, factorisations = 0;
};

Course run(const ReadyModel& model, ConstraintForm form, bool reuse) {
  NewtonOptions options;
  options.tangent = reuse ? Tangent::reused : Tangent::renewed;
  TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8), model.system.start(0),
                              form, options);
  integration.start(1e-3);
  Course motion;
  for (int k = 0; k < 1000; ++k) {
    const StepReport report = integration.step(1e-3);
    CHECK(report.worst_ratio <= 1);
    motion.iterations += report.iterations;
    motion.factorisations += report.factorisations;
  }
  motion.end = integration.state();
  return motion;
}

/// A mass on a spring that softens like tanh: from afar Newton's step leads to the other side, farther each time.
const char* const soft_spring = R"yaml(
nodes: {m: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}}
elements: {s: {type: spring_damper, nodes: [ground, m], force: "100*tanh(e/0.01)", length: 0.98}}
)yaml";

}  // namespace

TEST_CASE("tangents that serve several iterations give the motion of those that do not, with fewer factorisations") {
  const ReadyModel model(chain);
  for (const ConstraintForm form : {ConstraintForm::position, ConstraintForm::stabilised}) {
    const Course renewed = run(model, form, false), reused = run(model, form, true);
    CHECK(renewed.factorisations == renewed.iterations);
    CHECK(reused.factorisations < renewed.factorisations / 2);
    // Residuals are within 1e-9 of the forces in both; a thousand steps add up.
    CHECK((model.node(reused.end, "c").x - model.node(renewed.end, "c").x).norm() < 1e-7);
    CHECK((reused.end.multiplier - renewed.end.multiplier).norm() < 1e-6 * renewed.end.multiplier.norm());
  }
}

TEST_CASE("a step that makes the residual larger is shortened") {
  const ReadyModel model(soft_spring);
  NewtonOptions options;
  State state = model.system.start(0);
  solve_statics(model.system, model.environment(), 1, options, state);
  CHECK(model.node(state, "m").x.x() == Approx(0.98).margin(1e-10));
  options.line_search = false;
  State other = model.system.start(0);
  CHECK_THROWS_AS(solve_statics(model.system, model.environment(), 1, options, other), bielle::ComputationError);
}

TEST_CASE("a way far off and back leaves nothing in velocities and accelerations") {
  // A mass flies into a spring with factors that do not contain it: Newton's first step leads 1e5 m away.
  const ReadyModel model(R"yaml(
nodes: {mass: {position: [0.0155, 0, 0], velocity: [-1.0123456789, 0, 0], fixed: [y, z, rx, ry, rz]}}
elements:
  mass: {type: point_mass, node: mass, mass: 1}
  wall: {type: spring_damper, nodes: [ground, mass], length: 0.01, force: "1e16*e*(e < 0)"}
)yaml");
  const double h = 1e-3;
  double jolt = 0, v = 0, a = 0;
  State before;
  integrate(model, Scheme::newmark(), h, 0.01, [&](const State& state) {
    const NodeState& mass = model.node(state, "mass");
    v = mass.v.x();
    a = mass.a.x();
    if (state.time > 0) {
      const NodeState& last = model.node(before, "mass");
      jolt = std::max(jolt, std::abs(a - last.a.x()));
      CHECK(std::abs(v - last.v.x() - 0.5 * h * (a + last.a.x())) < 1e-14 * (1 + h * std::abs(a)));
    }
    before = state;
  });
  CHECK(jolt > 1000);
}

TEST_CASE("a node that makes a full turn in one step is refused by name") {
  const ReadyModel model(R"yaml(
nodes: {rotor: {position: [0, 0, 0], angular_velocity: [0, 0, 60]}}
elements: {rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [0.1, 0.1, 0.1]}}
)yaml");
  TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8), model.system.start(0));
  integration.start(0.1);
  const StepReport report = integration.attempt(0.1);
  CHECK_FALSE(report.converged());
  CHECK_THAT(report.refusal, Catch::Contains("node 'rotor' turns by 6 rad in one step"));
  CHECK(integration.attempt(0.05).converged());
}

}  // namespace test_newton
