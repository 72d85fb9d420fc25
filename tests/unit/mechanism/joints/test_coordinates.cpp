// Coordinates of joints over many turns, as they are recorded.
#include <catch2/catch.hpp>

#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

std::string rotor(const std::string& spin, const std::string& rest = "") {
  return R"yaml(
nodes: {rotor: {position: [0, 0, 0], angular_velocity: [0, 0, )yaml" +
         spin + R"yaml(]}}
elements: {rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [0.3, 0.3, 0.5]}}
joints: {axle: {type: hinge, nodes: [ground, rotor], axis: [0, 0, 1]}}
)yaml" + rest;
}

double recorded_angle(const ReadyModel& model, const State& state) {
  double joint[16];
  model.file.model.members()[1].component->write_output(LocalState(state, model.system.slots()[1], model.environment()),
                                                        joint);
  return joint[0];
}

}  // namespace

TEST_CASE("turns are counted also where a step turns by more than half of one") {
  for (const double spin : {500.0, -500.0}) {
    const ReadyModel model(rotor(std::to_string(spin)));
    // 5 rad in each step, exact for the scheme: constant speed.
    const State state = integrate(model, Scheme::generalized_alpha(0.8), 0.01, 1.0);
    CHECK_THAT(recorded_angle(model, state), Catch::WithinRel(spin, 1e-10));
  }
}

TEST_CASE("turns are counted where a fast rotor speeds up") {
  const ReadyModel model(rotor("0", "drives: {motor: {joint: axle, torque: \"250\"}}\n"));
  // Angle 250 t^2: up to 5 rad in a step, and 0.05 rad more in each step than in the one before.
  const State state = integrate(model, Scheme::generalized_alpha(0.8), 0.01, 1.0);
  CHECK_THAT(recorded_angle(model, state), Catch::WithinRel(250.0, 1e-6));
}

TEST_CASE("a drive that starts some turns away counts them in its joint") {
  const ReadyModel model(rotor("0", "drives: {motor: {joint: axle, angle: \"40 + 3*t\"}}\n"));
  const State state = integrate(model, Scheme::generalized_alpha(0.8), 0.01, 0.5);
  CHECK_THAT(recorded_angle(model, state), Catch::WithinRel(41.5, 1e-10));
}

TEST_CASE("a drive that starts at half a turn finds it") {
  const ReadyModel model(rotor("0", "drives: {motor: {joint: axle, angle: \"pi\"}}\n"));
  const State state = integrate(model, Scheme::generalized_alpha(0.8), 0.01, 0.02);
  CHECK_THAT(recorded_angle(model, state), Catch::WithinRel(M_PI, 1e-12));
  CHECK((model.node(state, "rotor").R.col(0) + Vector3::UnitX()).norm() < 1e-12);
}
