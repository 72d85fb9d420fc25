// Sessions without a file: models made in memory, assembled, at rest, read.
#include <cmath>

#include "swinging_arms.hpp"
#include <catch2/catch.hpp>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/elements/rigid_body/rigid_body.hpp"
#include "mechanism/solvers/start/start_report.hpp"
#include "tests/support/messages.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::message_of;
using bielle::test::swing;
using bielle::test::swinging_arms;
using Catch::Contains;

TEST_CASE("a model made of C++ objects falls as a stone does") {
  Model model;
  model.environment.gravity = {0, 0, -10};
  Node node;
  node.name = "stone";
  node.velocity = {3, 0, 4};
  const int stone = model.add_node(node);
  model.add(std::make_unique<RigidBody>("rigid_body", "stone", stone, 2.0 * sphere(0.1)),
            Entry{Section::elements, "stone"});
  Session session(std::move(model));
  Motion motion = session.dynamics(swing(0.5));
  REQUIRE(motion.finish());
  // The scheme is exact for constant accelerations.
  CHECK(session.time() == 0.5);
  CHECK(session.node("stone").x.x() == Approx(1.5).epsilon(1e-12));
  CHECK(session.node("stone").x.z() == Approx(2 - 1.25).epsilon(1e-12));
  CHECK(session.read("nodes/stone/velocity")[2] == Approx(4 - 5).epsilon(1e-12));
  CHECK(session.balance() == Approx(0).margin(1e-12 * session.energy().kinetic));
}

TEST_CASE("an assembly moves the parts together and makes the velocities fit") {
  Session session(swinging_arms().model);
  State torn = session.state();
  torn.nodes[static_cast<std::size_t>(*session.model().find_node("lower"))].v.z() = 0;
  session.set_state(torn);
  const StartReport start = session.assemble();
  CHECK(start.largest_displacement < 1e-12);
  CHECK(start.velocity_change > 1);
  // The elbows of both arms move alike.
  const NodeState &upper = session.node("upper"), &lower = session.node("lower");
  const Vector3 of_upper = upper.v + upper.R * upper.Omega.cross(Vector3(0.5, 0, 0)),
                of_lower = lower.v + lower.R * lower.Omega.cross(Vector3(-0.5, 0, 0));
  CHECK((of_upper - of_lower).norm() < 1e-12 * lower.v.norm());
}

TEST_CASE("statics end in equilibrium, and what is read is under their load factor") {
  // A bar hangs from a spring, whose force is its weight.
  const std::string text = R"yaml(
gravity: [0, 0, -10]
nodes: {bar: {position: [0, 0, -1], fixed: [x, y, rx, ry, rz]}}
elements:
  bar: {type: point_mass, node: bar, mass: 3}
  spring: {type: spring_damper, nodes: [ground, bar], stiffness: 600, length: 1}
loads: {pull: {node: bar, force: [0, 0, -30]}}
)yaml";
  Session session(read_mechanism_text(text, "bar.yaml").model);
  StaticsOptions options;
  options.steps = 4;
  std::vector<double> forces;
  session.on_step([&](Session& at) { forces.push_back(at.read("elements/spring/force")[0]); });
  const StaticsReport report = compute_statics(session, options);
  CHECK(report.points == 4);
  CHECK(report.load_factor == 1);
  REQUIRE(forces.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) CHECK(forces[k] == Approx(15.0 * static_cast<double>(k + 1)).epsilon(1e-8));
  CHECK(session.node("bar").x.z() == Approx(-1.1).epsilon(1e-9));
  CHECK(session.loaded().factor == 1);

  // A callback that stops the analysis leaves the session at the load factor reached; the next analysis continues from
  // there.
  Session again(read_mechanism_text(text, "bar.yaml").model);
  std::vector<double> saved;
  again.on_step([&](Session& at) {
    if (at.acting().load_factor == 0.25) saved = at.save();
    if (at.acting().load_factor == 0.5) at.stop();
  });
  CHECK(compute_statics(again, options).points == 2);
  CHECK(again.loaded().factor == 0.5);
  CHECK(again.acting().gravity.z() == -5);
  CHECK(again.node("bar").x.z() == Approx(-1.05).epsilon(1e-9));
  CHECK(again.read("time")[0] == 0.5);
  options.steps = 1;
  CHECK(compute_statics(again, options).load_factor == 1);
  Session from_callback(read_mechanism_text(text, "bar.yaml").model);
  from_callback.restore(saved);
  CHECK(from_callback.loaded().factor == 0.25);
  CHECK(from_callback.node("bar").x.z() == Approx(-1.025).epsilon(1e-9));
  CHECK(again.node("bar").x.z() == Approx(-1.1).epsilon(1e-9));
}

TEST_CASE("datasets are read by their names, those that `only` leaves out too") {
  Session session(swinging_arms("output: {only: {nodes: [lower], joints: []}}").model);
  CHECK(session.read("joints/elbow/coordinate") == std::vector<double>{0});
  CHECK(session.read("nodes/upper/position") == std::vector<double>{0.5, 0, 0});
  CHECK(session.read("nodes/lower/rotation") == std::vector<double>{1, 0, 0, 0});
  CHECK(session.read("elements/spring/length")[0] == Approx(std::hypot(0.5, 3)));
  CHECK(session.read("energy/kinetic")[0] == Approx(0.5 * 225 + 0.5 * 0.1 * 900));
  CHECK(session.energy().kinetic == session.read("energy/kinetic")[0]);
  CHECK_THAT(message_of<InputError>([&] { session.read("joints/elbw/coordinate"); }),
             Contains("did you mean 'joints/elbow/coordinate'"));
  CHECK_THAT(message_of<InputError>([&] { session.node("uper"); }), Contains("did you mean 'upper'"));
}

TEST_CASE("constraints that repeat others are set aside and named") {
  Session session(read_mechanism_text(R"yaml(
nodes: {arm: {position: [1, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints:
  front: {type: hinge, nodes: [ground, arm], position: [0, 0, 0.2], axis: [0, 1, 0]}
  rear: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 1, 0]}
)yaml",
                                      "blocked.yaml")
                      .model);
  CHECK(session.redundant() == std::vector<std::string>{"y, z, rx, ry of joint 'rear'"});
}
