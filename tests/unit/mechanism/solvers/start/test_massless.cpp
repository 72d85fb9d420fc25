// Directions without mass at the start of a motion and after jumps of forces.
#include <catch2/catch.hpp>

#include "mechanism/session/session.hpp"
#include "mechanism/solvers/start/consistent_start.hpp"
#include "mechanism/solvers/start/massless_balance.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

/// Returns a chain: ground - spring (1000 N/m, damper c) - p without mass - spring (3000 N/m) - m of 1 kg, which moves
/// at 1 m/s.
std::string series(const std::string& p, const std::string& c, const std::string& load = "") {
  return R"yaml(
nodes:
  p: {position: [)yaml" +
         p + R"yaml(, 0, 0], fixed: [y, z, rx, ry, rz]}
  m: {position: [2.3, 0, 0], velocity: [1, 0, 0], fixed: [y, z, rx, ry, rz]}
elements:
  inner: {type: spring_damper, nodes: [ground, p], stiffness: 1000, length: 0.5, damping: )yaml" +
         c + R"yaml(}
  outer: {type: spring_damper, nodes: [p, m], stiffness: 3000, length: 1.5}
  m: {type: point_mass, node: m, mass: 1}
)yaml" + load;
}

}  // namespace

TEST_CASE("a node without mass starts where its forces balance, at the velocity that keeps them balanced") {
  const ReadyModel model(series("0.3", "0"));
  State state = model.system.start(0);
  const StartReport report = make_consistent(model.system, model.environment(), state);
  // 1000 (x - 0.5) = 3000 (2.3 - x - 1.5)
  CHECK(model.node(state, "p").x.x() == Approx(0.725).epsilon(1e-12));
  CHECK(model.node(state, "p").v.x() == Approx(0.75).epsilon(1e-8));
  // Parts with mass are held by 1e13 times the stiffness.
  CHECK(model.node(state, "m").x.x() == Approx(2.3).epsilon(1e-12));
  CHECK(model.node(state, "m").v.x() == 1);
  CHECK(model.node(state, "m").a.x() == Approx(-225).epsilon(1e-10));
  CHECK(report.balanced == Approx(0.425));
  CHECK(report.balanced_node == "p");
  CHECK(report.unbalanced.empty());
}

TEST_CASE("a damped node without mass stays where it is drawn, and starts with the velocity that its damper allows") {
  const ReadyModel model(series("0.3", "10"));
  State state = model.system.start(0);
  const StartReport report = make_consistent(model.system, model.environment(), state);
  // 10 v = 3000 * 0.5 + 1000 * 0.2
  CHECK(model.node(state, "p").x.x() == Approx(0.3).epsilon(1e-12));
  CHECK(model.node(state, "p").v.x() == Approx(170).epsilon(1e-10));
  CHECK(model.node(state, "m").a.x() == Approx(-1500).epsilon(1e-10));
  CHECK(report.balanced < 1e-9);
}

TEST_CASE("a node without mass between a hinged body and a spring is balanced under its joint's reaction") {
  // The tip, held to the bar's end by a ball joint, carries nothing and is pulled by a spring: nothing to move.
  const ReadyModel model(R"yaml(
gravity: [0, 0, -9.81]
nodes:
  bar: {position: [0.5, 0, 0]}
  tip: {position: [1, 0, 0], fixed: [rx, ry, rz]}
elements:
  bar: {type: rigid_body, node: bar, mass: 1, inertia: [0.01, 0.1, 0.1]}
  pull: {type: spring_damper, nodes: [ground, tip], stiffness: 100, length: 0.5}
joints:
  pivot: {type: hinge, nodes: [ground, bar], position: [0, 0, 0], axis: [0, 1, 0]}
  ball: {type: spherical, nodes: [bar, tip]}
)yaml");
  State state = model.system.start(0);
  const StartReport report = make_consistent(model.system, model.environment(), state);
  CHECK(report.balanced < 1e-12);
  CHECK(report.unbalanced.empty());
  CHECK(model.node(state, "tip").x.x() == Approx(1).epsilon(1e-13));
}

TEST_CASE("velocities of a node without mass stay of the motion's size from the first step on and across a jump") {
  const ReadyModel model(series("0.3", "0", "loads: {push: {node: p, force: [\"100*(t>0.01)\", 0, 0]}}\n"));
  TimeIntegration integration(model.system, model.environment(), Scheme::generalized_alpha(0.8), model.system.start(0));
  const double h = 1e-3;
  integration.start(h);
  for (int k = 0; k < 20; ++k) {
    if (k == 10) integration.restart(h);
    const StepReport report = integration.attempt(h, (k + 1) * h, k == 9);
    REQUIRE(report.converged());
    integration.accept();
    const double t = integration.state().time, p = model.node(integration.state(), "p").x.x(),
                 m = model.node(integration.state(), "m").x.x();
    INFO("t = " << t);
    CHECK(4000 * p == Approx(500 + 3000 * (m - 1.5) + (k >= 10 ? 100 : 0)).epsilon(1e-9));
    CHECK(std::abs(model.node(integration.state(), "p").v.x()) < 4);  // the mass moves at 1 to -3.5 m/s
  }
}

TEST_CASE("nodes without mass keep the rates that drives prescribe, next to one that is balanced by springs") {
  // The wheel and its pinion have no mass either: the pinion turns at -60 * 0.2/0.1 and the wheel at 60 rad/s.
  std::string text = series("0.3", "0");
  text.insert(text.find("elements:"), "  wheel: {position: [0, 5, 0]}\n  pinion: {position: [0.3, 5, 0]}\n");
  const ReadyModel model(text + R"yaml(
joints:
  crank: {type: hinge, nodes: [ground, wheel], axis: [0, 0, 1]}
  shaft: {type: hinge, nodes: [ground, pinion], axis: [0, 0, 1]}
  teeth: {type: gear, joints: [crank, shaft], factors: [2, 1]}
drives: {motor: {joint: crank, rate: 60}}
)yaml");
  State state = model.system.start(0);
  const StartReport report = make_consistent(model.system, model.environment(), state);
  CHECK(report.unbalanced.empty());
  CHECK(model.node(state, "wheel").Omega.z() == Approx(60).epsilon(1e-9));
  CHECK(model.node(state, "pinion").Omega.z() == Approx(-120).epsilon(1e-9));
  CHECK(model.node(state, "p").v.x() == Approx(0.75).epsilon(1e-8));
}

TEST_CASE("a clutch on a shaft without mass slips on when a stop is met elsewhere") {
  // The shaft turns at 60 rad/s, without mass; friction takes the disc along by 0.3 * 300 N * 0.08 m until it meets an
  // elastic stop, far below the shaft's speed.
  const MechanismFile file = read_mechanism_text(R"yaml(
nodes: {shaft: {}, disc: {}}
elements: {disc: {type: rigid_body, node: disc, mass: 1, inertia: [1, 1, 1]}}
joints:
  crank: {type: hinge, nodes: [ground, shaft], axis: [0, 0, 1]}
  plates: {type: hinge, nodes: [shaft, disc], axis: [0, 0, 1], start_rate: -60,
           friction: {model: stick_slip, coefficient: 0.3, radius: 0.08, preload: 300}}
  bearing: {type: hinge, nodes: [ground, disc], axis: [0, 0, 1], stops: {range: [~, 0.02], stiffness: 1e4, damping: 50}}
drives: {engine: {joint: crank, rate: 60}}
)yaml",
                                                 "model.yaml");
  Session session(file.model);
  DynamicsOptions options;
  options.duration = 0.1;
  options.stepping.size = 1e-3;
  Motion motion = session.dynamics(options);
  double most_turned = 0;
  while (motion.step()) {
    const double time = motion.state().time;
    INFO("t = " << time);
    CHECK(session.read("joints/plates/friction")[0] == Approx(7.2).epsilon(1e-9));
    CHECK(session.read("joints/plates/sticks")[0] == 0);
    CHECK(session.read("joints/crank/rate")[0] == Approx(60).epsilon(1e-9));
    CHECK(session.read("joints/crank/coordinate")[0] == Approx(60 * time).epsilon(1e-9));
    most_turned = std::max(most_turned, session.read("joints/bearing/coordinate")[0]);
  }
  CHECK(most_turned > 0.02);
}
