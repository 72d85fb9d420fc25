// Steps: their ends, the causes of reduction, and their local error.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/math/so3.hpp"
#include "mechanism/solvers/dynamics/error_norm.hpp"
#include "tests/support/march_model.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace {

/// Returns a mass of 1 kg on a spring of (2 pi)^2 N/m along x: period 1 s. `force` acts along x.
std::string oscillator(const std::string& force, double start) {
  return "nodes: {m: {position: [" + std::to_string(1 + start) + R"yaml(, 0, 0], fixed: [y, z, rx, ry, rz]}}
elements:
  m: {type: point_mass, node: m, mass: 1}
  s: {type: spring_damper, nodes: [ground, m], stiffness: "(2*pi)^2", length: 1}
loads: {f: {node: m, force: [")yaml" +
         force + "\", 0, 0]}}\n";
}

double x_of(const ReadyModel& model, const State& state) { return model.node(state, "m").x.x() - 1; }

}  // namespace

TEST_CASE("fixed steps keep to their grid and end on a kink between its times") {
  const ReadyModel model(oscillator("5*(t>=0.25)", 0));
  const Course motion = march(model, 1, fixed_steps(0.1));
  REQUIRE(motion.visits.size() == 11);
  CHECK(motion.visits[2].time == 0.25);
  CHECK_FALSE(motion.visits[2].on_grid);
  for (const int k : {0, 1}) CHECK(motion.visits[static_cast<std::size_t>(k)].time == Approx(0.1 * (k + 1)));
  for (int k = 3; k < 11; ++k) CHECK(motion.visits[static_cast<std::size_t>(k)].time == Approx(0.1 * k));
  CHECK(motion.visits.back().time == 1.0);
}

TEST_CASE("a force that jumps, at the start or between two times of the grid, leaves the order at 2") {
  // x = F/k (1 - cos 2 pi (t - t0)) after the jump, nothing before it, for either value at the time of the jump itself.
  const double pi = std::acos(-1.0), end = 0.8;
  for (const auto& [law, t0] :
       {std::pair("5*(t>=0.0437)", 0.0437), std::pair("5*(t>0.0437)", 0.0437), std::pair("5*(t>0)", 0.0)}) {
    const ReadyModel model(oscillator(law, 0));
    const double exact = 5 / (4 * pi * pi) * (1 - std::cos(2 * pi * (end - t0)));
    double h = 0.01, coarse = std::abs(x_of(model, march(model, end, fixed_steps(h)).end) - exact);
    for (int halving = 0; halving < 4; ++halving) {
      h /= 2;
      const double fine = std::abs(x_of(model, march(model, end, fixed_steps(h)).end) - exact);
      INFO(law << ", h = " << h << ": " << coarse << " -> " << fine);
      CHECK(std::log2(coarse / fine) == Approx(2).margin(0.1));
      coarse = fine;
    }
  }
}

TEST_CASE("the local error of a step is what the norm says") {
  // One step of an oscillator from rest at amplitude 0.1: the exact position is 0.1 cos(2 pi h). The extent is the
  // node's distance from the origin.
  const double pi = std::acos(-1.0);
  for (const double rho : {0.0, 0.5, 0.8, 1.0}) {
    double ratio_before = 0;
    for (const double h : {4e-3, 2e-3, 1e-3}) {
      // The step is in the middle of its swing, where the rate of the acceleration is largest.
      const ReadyModel model(R"yaml(
nodes: {m: {position: [1, 0, 0], velocity: [0.6, 0, 0], fixed: [y, z, rx, ry, rz]}}
elements:
  m: {type: point_mass, node: m, mass: 1}
  s: {type: spring_damper, nodes: [ground, m], stiffness: "(2*pi)^2", length: 1}
)yaml");
      TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(rho),
                                  model.system.start(0));
      integration.start(h);
      REQUIRE(integration.attempt(h).converged());
      const double estimate = integration.position_error()[0];
      integration.accept();
      const double error = 0.6 / (2 * pi) * std::sin(2 * pi * h) - x_of(model, integration.state());
      // The ratio of the true to the estimated error approaches 1 with h.
      CHECK(error / estimate == Approx(1).margin(20 * h));
      ratio_before = error / estimate;
    }
    CHECK(ratio_before == Approx(1).margin(0.01));
  }
}

TEST_CASE("adaptive steps keep the local error below the tolerance, and the global error goes with it") {
  const double pi = std::acos(-1.0), end = 3.3;
  const ReadyModel model(oscillator("0", 0.1));
  double error_before = 0;
  for (const double tolerance : {1e-5, 1e-6, 1e-7, 1e-8}) {
    const Course motion = march(model, end, adaptive_steps(1e-3, tolerance));
    for (const Visit& visit : motion.visits) CHECK(visit.error <= 1);
    const double error = std::abs(x_of(model, motion.end) - 0.1 * std::cos(2 * pi * end));
    INFO("tolerance " << tolerance << ": " << motion.log.steps << " steps, error " << error);
    CHECK(motion.visits.back().time == end);
    // Order 2 against exponent 1/3: the global error falls with tolerance^(2/3), a factor of 4.6 per decade.
    if (error_before > 0) CHECK(error_before / error == Approx(4.64).epsilon(0.5));
    error_before = error;
  }
}

namespace {

/// A double pendulum released from the horizontal.
const char* const double_pendulum = R"yaml(
gravity: [0, 0, -9.81]
nodes: {upper: {position: [0.5, 0, 0]}, lower: {position: [1.5, 0, 0]}}
elements:
  upper: {type: rigid_body, node: upper, mass: 2, inertia: [0.01, 0.2, 0.2]}
  lower: {type: rigid_body, node: lower, mass: 1, inertia: [0.01, 0.1, 0.1]}
joints:
  shoulder: {type: hinge, nodes: [ground, upper], position: [0, 0, 0], axis: [0, 1, 0]}
  elbow: {type: hinge, nodes: [upper, lower], position: [1, 0, 0], axis: [0, 1, 0]}
)yaml";

}  // namespace

TEST_CASE("steps that change and change again do not feed on what they left in the accelerations") {
  // With constraints of index 3 and little dissipation, the local error was once only dissipation, which led to steps
  // of 1e-10 s.
  const ReadyModel model(double_pendulum);
  for (const double rho : {0.95, 0.9, 0.8, 0.5}) {
    TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(rho),
                                model.system.start(0));
    March march(integration, 0, 1, adaptive_steps(0.02, 1e-6));
    while (!march.done()) march.advance();
    INFO("rho = " << rho);
    // The local error's constants of these schemes differ by 1.6, the steps by 1.2.
    CHECK(march.log().steps < 350);
    CHECK(march.log().smallest > 1e-4);
  }
}

TEST_CASE("the true error of each adaptive step is within the tolerance, in stiff and in slow motions") {
  // Each step is computed again in 50 parts from the state at its beginning. The stiff pendulum hangs on a spring whose
  // own vibration, of 0.1 ms, is 1e4 times faster than its swing: it starts in the length that it keeps.
  const char* const stiff = R"yaml(
gravity: [0, 0, -9.81]
nodes: {bob: {position: [1, 0, 0], fixed: [y, rx, ry, rz]}}
elements:
  bob: {type: point_mass, node: bob, mass: 1}
  rod: {type: spring_damper, nodes: [ground, bob], stiffness: 4e9, length: 1}
)yaml";
  for (const char* const text : {double_pendulum, stiff})
    for (const double tolerance : {1e-5, 1e-6}) {
      const ReadyModel model(text);
      const Scheme scheme = Scheme::generalized_alpha(0.8);
      TimeIntegration integration(model.system, model.environment(), scheme, model.system.start(0));
      March march(integration, 0, 1, adaptive_steps(1e-3, tolerance));
      double worst = 0;
      long count = 0;
      while (!march.done()) {
        const State before = integration.state();
        const double h = march.advance().report.size;
        if (++count % 5 != 0) continue;
        TimeIntegration fine(model.system, model.environment(), scheme, before);
        fine.start(h / 50);
        for (int k = 0; k < 50; ++k) fine.step(h / 50);
        // The error as error_norm.hpp weighs it: masses and inertias are alike here, the extent is about 1 m.
        for (std::size_t i = 1; i < before.nodes.size(); ++i)
          worst = std::max(worst, (integration.state().nodes[i].x - fine.state().nodes[i].x).norm());
      }
      INFO((text == stiff ? "stiff" : "double pendulum")
           << ", tolerance " << tolerance << ": " << march.log().steps << " steps, true error " << worst);
      CHECK(worst < 2 * tolerance);
      CHECK(worst > 0.05 * tolerance);
      CHECK(march.log().steps < (tolerance > 2e-6 ? 200 : 400));
    }
}

TEST_CASE("adaptive steps shorten for a short push, end on its kinks and lengthen again") {
  const ReadyModel model(oscillator("500*pulse(t, 0.5, 0.502)", 0.0));
  const Course motion = march(model, 2, adaptive_steps(1e-2, 1e-5));
  bool at_begin = false, at_end = false;
  for (const Visit& visit : motion.visits) {
    at_begin = at_begin || visit.time == 0.5;
    at_end = at_end || visit.time == 0.502;
  }
  CHECK(at_begin);
  CHECK(at_end);
  // The push gives 1 m/s: x = sin(2 pi t)/(2 pi) from its middle on, but for terms of the push's length squared.
  const double pi = std::acos(-1.0);
  CHECK(x_of(model, motion.end) == Approx(std::sin(2 * pi * (2 - 0.501)) / (2 * pi)).margin(2e-3));
}

TEST_CASE("a step that cannot be solved is halved, and its grid is kept") {
  // A spring whose law exists up to 0.15 m only. The mass never gets there from 0.1 m, but the predictor of such a long
  // step does.
  const ReadyModel model(R"yaml(
nodes: {m: {position: [1.1, 0, 0], fixed: [y, z, rx, ry, rz]}}
elements:
  m: {type: point_mass, node: m, mass: 1}
  s: {type: spring_damper, nodes: [ground, m], force: "(2*pi)^2*e/sqrt(1 - (e/0.15)^2)", length: 1}
)yaml");
  const Course motion = march(model, 4, fixed_steps(0.4));
  CHECK(motion.log.refused_by_newton > 0);
  CHECK_THAT(motion.log.hardest, Catch::Matchers::Contains("sqrt"));
  long on_grid = 0;
  for (const Visit& visit : motion.visits) on_grid += visit.on_grid;
  CHECK(on_grid == 10);
  CHECK(motion.visits.back().time == 4.0);
  CHECK(motion.log.steps == static_cast<long>(motion.visits.size()));
}

TEST_CASE("a motion that leaves what its components know ends with their reason and the steps tried") {
  const ReadyModel model(R"yaml(
nodes: {m: {position: [1.1, 0, 0], velocity: [2, 0, 0], fixed: [y, z, rx, ry, rz]}}
elements:
  m: {type: point_mass, node: m, mass: 1}
  s: {type: spring_damper, nodes: [ground, m], force: "e*sqrt(0.15 - e)", length: 1}
)yaml");
  CHECK_THROWS_WITH(march(model, 1, fixed_steps(0.01)),
                    Catch::Matchers::Contains("sqrt(0.15 - e)") && Catch::Matchers::Contains("steps down to"));
}

TEST_CASE("positions between two steps are as exact as the steps") {
  const double pi = std::acos(-1.0);
  const ReadyModel model(oscillator("0", 0.1));
  double before = 0;
  for (const double h : {0.02, 0.01, 0.005}) {
    TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8),
                                model.system.start(0));
    integration.start(h);
    double worst = 0;
    for (int k = 0; k < std::lround(0.4 / h); ++k) {
      integration.step(h);
      const double t = integration.state().time - 0.37 * h;
      const State between = integration.interpolated(t);
      const NodeState& node = model.node(between, "m");
      worst = std::max({worst, std::abs(x_of(model, between) - 0.1 * std::cos(2 * pi * t)),
                        std::abs(node.v.x() + 0.2 * pi * std::sin(2 * pi * t)) / (2 * pi),
                        std::abs(node.a.x() + 0.4 * pi * pi * std::cos(2 * pi * t)) / (4 * pi * pi)});
    }
    if (before > 0) CHECK(std::log2(before / worst) == Approx(2).margin(0.15));
    before = worst;
  }
}

TEST_CASE("rotations between two steps lie on the path of the motion") {
  // A body spinning freely about its principal axis, 2 rad per step.
  const ReadyModel model(R"yaml(
nodes: {b: {position: [0.3, 0, 0], velocity: [1, 2, 3], angular_velocity: [0, 0, 20]}}
elements: {b: {type: rigid_body, node: b, mass: 1, inertia: [0.1, 0.1, 0.1]}}
)yaml");
  TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8), model.system.start(0));
  integration.start(0.1);
  integration.step(0.1);
  integration.step(0.1);
  const NodeState node = model.node(integration.interpolated(0.13), "b");
  CHECK((node.x - Vector3(0.3 + 0.13, 0.26, 0.39)).norm() < 1e-13);
  CHECK((node.R - exp_so3(Vector3(0, 0, 2.6))).norm() < 1e-13);
  CHECK((node.Omega - Vector3(0, 0, 20)).norm() < 1e-12);
}

TEST_CASE("the first steps do not depend on the axes along which a mechanism is drawn") {
  // Two wheels turn in place: the accelerations of their centres are rounding, unless the axes are inertial ones.
  const auto approach_after_three_steps = [](const Vector3& turn) {
    const Matrix3 R = exp_so3(turn);
    const auto list = [](const Vector3& v) { return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]); };
    const double h = 1e-3;
    Session session = session_of(fmt::format(R"yaml(
nodes:
  w1: {{rotation_vector: {0}}}
  w2: {{rotation_vector: {0}, position: {2}}}
elements:
  b1: {{type: rigid_body, node: w1, mass: 1, inertia: [1e-3, 1e-3, 1e-3]}}
  b2: {{type: rigid_body, node: w2, mass: 1, inertia: [1e-3, 1e-3, 2e-3]}}
joints:
  h1: {{type: hinge, nodes: [ground, w1], axis: {1}, start_rate: 20}}
  h2: {{type: hinge, nodes: [ground, w2], axis: {1}, start_rate: -7}}
  teeth: {{type: gear_mesh, nodes: [w1, w2], axes: {1}, radii: [0.02, 0.05], stiffness: "1e5*(1 + 0.5*sin(20*phi))",
          errors: "1e-5*cos(20*phi)"}}
)yaml",
                                             list(turn), list(R.col(2)), list(0.07 * R.col(0))));
    session.dynamics(steps_of(3 * h, h)).finish();
    return session.read("joints/teeth/approach")[0];
  };
  const double drawn = approach_after_three_steps(Vector3::Zero());
  CHECK(drawn > 5e-5);
  for (const Vector3& turn : {Vector3(0.5, -0.9, 0.7), Vector3(0.4, 1.1, -0.7), Vector3(1, 0.2, -0.3)})
    CHECK(approach_after_three_steps(turn) == Approx(drawn).epsilon(1e-8));
}
