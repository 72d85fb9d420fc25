#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/start/consistent_accelerations.hpp"
#include "mechanism/solvers/start/consistent_start.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::ReadyModel;

TEST_CASE("the start of a pendulum at an angle has its tension and acceleration in closed form") {
  // Point mass m on a rod of length L, held horizontally and moving at v: tension m v^2/L, acceleration g downwards.
  const MechanismFile file = read_mechanism_text(R"yaml(
gravity: [0, 0, -9.81]
nodes: {bob: {position: [2, 0, 0], velocity: [0, 3, 0]}}
elements: {bob: {type: rigid_body, node: bob, mass: 1.5, inertia: [1e-3, 1e-3, 1e-3]}}
joints: {pivot: {type: spherical, nodes: [ground, bob], position: [0, 0, 0]}}
)yaml",
                                                 "pendulum.yaml");
  System system(file.model);
  State state = system.start(0);
  make_consistent(system, file.model.environment, state);
  const NodeState& bob = state.nodes.back();
  // The given velocity is a translation; kept in the energy norm, the body must turn with its velocity: almost all
  // stays.
  const double J = 1e-3, m = 1.5, L = 2;
  const double turn = m * L * 3 / (m * L * L + J);  // angular velocity about z: least change in the mass norm
  CHECK(bob.v.y() == Approx(turn * L).epsilon(1e-12));
  CHECK(bob.Omega.z() == Approx(turn).epsilon(1e-12));
  const double fall = m * 9.81 * L / (m * L * L + J);  // angular acceleration about y
  CHECK(bob.a.z() == Approx(-fall * L).epsilon(1e-12));
  CHECK(bob.a.x() == Approx(-turn * turn * L).epsilon(1e-12));
  // Along x the joint holds the centripetal force: residual = m a + B^T lambda, so B^T lambda = -m a.
  VectorX r(system.size());
  system.residual(state, file.model.environment, r);
  CHECK(r.cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("a drive that starts away from the drawn position moves its joint there, and says so") {
  const MechanismFile file = read_mechanism_text(R"yaml(
nodes: {arm: {position: [1, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints: {axle: {type: hinge, nodes: [ground, arm], axis: [0, 0, 1], position: [0, 0, 0]}}
drives: {motor: {joint: axle, angle: "0.5 + 2*t + 3*t^2"}}
)yaml",
                                                 "drive.yaml");
  System system(file.model);
  State state = system.start(0);
  const StartReport report = make_consistent(system, file.model.environment, state);
  const NodeState& arm = state.nodes.back();
  CHECK(report.displaced_node == "arm");
  CHECK(report.largest_displacement == Approx(2 * std::sin(0.25)).epsilon(1e-10));
  CHECK((arm.x - Vector3(std::cos(0.5), std::sin(0.5), 0)).norm() < 1e-12);
  CHECK(arm.Omega.z() == Approx(2).epsilon(1e-12));
  CHECK(arm.Omegadot.z() == Approx(6).epsilon(1e-10));
}

TEST_CASE("a mechanism that cannot be put together names what stays open") {
  // Two slides hold b's axes parallel to a's and to the ground's: a cannot turn about its ball joint, and b stays.
  const MechanismFile file = read_mechanism_text(R"yaml(
nodes: {a: {position: [1, 0, 0]}, b: {position: [5, 0, 0]}}
elements:
  a: {type: rigid_body, node: a, mass: 1, inertia: [0.1, 0.1, 0.1]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [0.1, 0.1, 0.1]}
joints:
  left: {type: spherical, nodes: [ground, a], position: [0, 0, 0]}
  slide: {type: prismatic, nodes: [ground, b], axis: [0, 1, 0]}
  link: {type: spherical, nodes: [a, b]}
  stop: {type: prismatic, nodes: [a, b], axis: [0, 0, 1]}
drives: {push: {joint: slide, displacement: "20"}}
)yaml",
                                                 "open.yaml");
  System system(file.model);
  State state = system.start(0);
  CHECK_THROWS_WITH(make_consistent(system, file.model.environment, state),
                    Catch::Contains("drive 'push' stays 20 m away from what it prescribes"));
}

TEST_CASE("a node without mass that nothing holds is named") {
  const MechanismFile file = read_mechanism_text(R"yaml(
nodes: {a: {position: [1, 0, 0]}, lonely: {position: [2, 0, 0]}}
elements:
  a: {type: point_mass, node: a, mass: 1}
  spring: {type: spring_damper, nodes: [a, lonely], stiffness: 10}
)yaml",
                                                 "massless.yaml");
  System system(file.model);
  State state = system.start(0);
  CHECK_THROWS_WITH(make_consistent(system, file.model.environment, state), Catch::Contains("node '"));
}

TEST_CASE("the turn of a body on a line about this line is named, in whatever axes, unless something holds it") {
  const auto start = [](const std::string& axes, const std::string& joints = "") {
    const MechanismFile file = read_mechanism_text(
        "nodes: {arm: {position: [1, 0, 0], rotation_vector: [0.2, 0.1, 0], angular_velocity: [0.1, 1, 0]}}\nelements: "
        "{arm: {type: rigid_body, node: arm, mass: 1, centre: [0.3, 0.4, 0], inertia: [0, 1, 1], inertia_axes: "
        "{axes: " +
            axes + "}}, other: {type: node_force, nodes: [ground, arm], force: [0, 0, 0]}}\n" + joints,
        "line.yaml");
    System system(file.model);
    State state = system.start(0);
    make_consistent(system, file.model.environment, state);
  };
  const std::string free = " in its axes: it has no mass, and nothing holds it";
  // The line passes through the node, or beside it.
  CHECK_THROWS_WITH(start("{x: [3, 4, 0], z: [0, 0, 1]}"),
                    Catch::Contains("rotation of node 'arm' about (0.6, 0.8, 0)" + free));
  CHECK_THROWS_WITH(start("{x: [0, 0, -1], y: [1, 0, 0]}"),
                    Catch::Contains("rotation of node 'arm' about (0, 0, 1)" + free));
  CHECK_NOTHROW(
      start("{x: [3, 4, 0], z: [0, 0, 1]}", "joints: {pivot: {type: hinge, nodes: [ground, arm], axis: [0, 0, 1]}}\n"));
}

TEST_CASE("a massless node beside a stiff spring leaves the accelerations of the masses alone") {
  // The pin carries nothing and turns freely beside the body's oblique arm. Gravity alone acts: everything falls.
  const MechanismFile file = read_mechanism_text(R"yaml(
gravity: [0, 0, -9.81]
nodes:
  body: {position: [1, 0, 0], rotation_vector: [0.3, -0.8, 0.4]}
  other: {position: [1, 2, 0]}
  pin: {position: [1.3, 0.2, 0.7], rotation_vector: [0.3, 0.2, 0.1]}
elements:
  body: {type: rigid_body, node: body, mass: 1, inertia: [0.1, 0.1, 0.1]}
  other: {type: rigid_body, node: other, mass: 1, inertia: [0.1, 0.1, 0.1]}
  stiff: {type: spring_damper, nodes: [body, other], stiffness: 1e13}
joints: {ball: {type: spherical, nodes: [body, pin], position: [1.5, 0.6, 0.1]}}
)yaml",
                                                 "stiff.yaml");
  System system(file.model);
  State state = system.start(0);
  make_accelerations_consistent(system, file.model.environment, state);
  for (const char* name : {"body", "other"}) {
    const NodeState& node = state.nodes[static_cast<std::size_t>(*file.model.find_node(name))];
    CHECK((node.a - Vector3(0, 0, -9.81)).norm() < 1e-8);
    CHECK(node.Omegadot.norm() < 1e-8);
  }
}

TEST_CASE("a node without mass on springs does not set off with an acceleration made of nothing") {
  // Body - spring - massless middle - spring - ground, stretched unevenly: the middle has no acceleration of its own.
  const MechanismFile file = read_mechanism_text(R"yaml(
nodes:
  body: {position: [2, 0, 0], fixed: [y, z, rx, ry, rz]}
  middle: {position: [1, 0, 0], fixed: [y, z, rx, ry, rz]}
elements:
  body: {type: point_mass, node: body, mass: 1}
  inner: {type: spring_damper, nodes: [ground, middle], stiffness: 100, length: 0.9}
  outer: {type: spring_damper, nodes: [middle, body], stiffness: 100, length: 0.5}
)yaml",
                                                 "series.yaml");
  System system(file.model);
  State state = system.start(0);
  make_accelerations_consistent(system, file.model.environment, state);
  const NodeState &body = state.nodes[1], &middle = state.nodes[2];
  CHECK(std::abs(middle.a.x()) < 1e-2);  // residual of 40 N over no mass: 1e-12 of the body's mass would leave 1e13
                                         // m/s^2
  CHECK(body.a.x() == Approx(-100 * 0.5));
}

TEST_CASE("a drive that starts elsewhere than drawn turns slender parts there, and does not bend them") {
  for (const double angle : {0.05, 1.5, 3.0}) {
    const ReadyModel model(R"yaml(
nodes: {a: {position: [0, 0, 0]}, b: {position: [0.3, 0, 0]}, tip: {position: [0.9, 0, 0]}}
elements:
  bar: {type: rigid_body, node: a, mass: 1, inertia: [0.01, 0.01, 0.01], also: [b]}
  fore: {type: beam, nodes: [b, tip], elements: 6, section: {tube: [0.012, 0.010], young: 210e9, poisson: 0.3, density: 7850}}
joints: {base: {type: hinge, nodes: [ground, a], axis: [0, 0, 1]}}
drives: {motor: {joint: base, angle: )yaml" +
                           std::to_string(angle) + "}}\n");
    State state = model.system.start(0);
    StartReport report;
    assemble_positions(model.system, model.environment(), state, report);
    CHECK((model.node(state, "tip").x - 0.9 * Vector3(std::cos(angle), std::sin(angle), 0)).norm() < 1e-9);
    // A bend by 1e-6 rad would store 1e-9 J.
    CHECK(model.system.energy(state, model.environment()).elastic < 1e-12);
    CHECK(report.displaced_node == "tip");
  }
}
