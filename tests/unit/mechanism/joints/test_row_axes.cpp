// Rows of constraints in axes that ride on a node, and in inertial ones: the same motion and the same reactions.
#include <catch2/catch.hpp>

#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/dynamics/time_integration.hpp"

using namespace bielle::mechanism;

namespace {

/// A chain that tumbles in space, of joints that lock three translations with no, some and all rotations.
constexpr const char* tumbling = R"yaml(
gravity: [0, 0, -9.81]
nodes:
  a: {position: [0.4, 0.1, 0], rotation_vector: [0.3, -0.5, 0.2], angular_velocity: [3, 1, -2]}
  b: {position: [1.2, 0.2, 0.1], rotation_vector: [0.1, 0.7, -0.4]}
  c: {position: [1.9, 0.1, 0.3]}
elements:
  a: {type: rigid_body, node: a, mass: 2, inertia: [0.02, 0.05, 0.04], centre: [0.01, 0.02, -0.03]}
  b: {type: rigid_body, node: b, mass: 1, inertia: [0.01, 0.02, 0.025]}
  c: {type: rigid_body, node: c, mass: 0.5, inertia: [0.01, 0.01, 0.01]}
joints:
  ball: {type: spherical, nodes: [ground, a], position: [0, 0, 0]}
  pin: {type: hinge, nodes: [a, b], position: [0.8, 0.2, 0.1], axis: [0.2, 1, -0.3]}
  weld: {type: rigid, nodes: [b, c], position: [1.5, 0.1, 0.2]}
)yaml";

struct Run {
  State state;
  std::vector<double> outputs;
  int entries;
};

Run tumble(bool carried_axes) {
  const MechanismFile file = read_mechanism_text(tumbling, "model.yaml");
  const Environment& environment = file.model.environment;
  System system(file.model);
  if (!carried_axes) system.set_aside({});
  TimeIntegration integration(system, environment, Scheme::generalized_alpha(0.8), system.start(0));
  integration.start(1e-3);
  for (int k = 0; k < 500; ++k) integration.step(1e-3);
  Run run{integration.state(), {}, system.pattern().entry_count()};
  for (std::size_t m = 3; m < 6; ++m) {
    double joint[24] = {};
    file.model.members()[m].component->write_output(LocalState(run.state, system.slots()[m], environment), joint);
    run.outputs.insert(run.outputs.end(), joint, joint + 24);
  }
  return run;
}

}  // namespace

TEST_CASE("rows in inertial axes and rows that ride on a node give one motion and the same reactions") {
  const Run carried = tumble(true), inertial = tumble(false);
  CHECK(inertial.entries < carried.entries);
  // Newton's tolerance of 1e-9 in each of 500 steps; multipliers have it divided by the compliance of a step.
  for (std::size_t i = 0; i < carried.state.nodes.size(); ++i) {
    CHECK((carried.state.nodes[i].x - inertial.state.nodes[i].x).norm() < 1e-9);
    CHECK((carried.state.nodes[i].R - inertial.state.nodes[i].R).norm() < 1e-9);
  }
  for (std::size_t k = 0; k < carried.outputs.size(); ++k)
    CHECK_THAT(inertial.outputs[k], Catch::Matchers::WithinAbs(carried.outputs[k], 1e-6));
}

TEST_CASE("a joint with a row set aside keeps its axes, the others are free to choose") {
  const MechanismFile file = read_mechanism_text(tumbling, "model.yaml");
  System system(file.model);
  const auto carried = [&](std::size_t joint) { return system.slots()[3 + joint].carried_axes; };
  CHECK((carried(0) && carried(1) && carried(2)));
  system.set_aside({4});  // rows of the hinge
  CHECK((!carried(0) && carried(1) && !carried(2)));
}
