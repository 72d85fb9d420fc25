#include <catch2/catch.hpp>

#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::integrate;
using bielle::test::ReadyModel;

namespace {

/// Returns an arm of inertia 0.5 kg m^2 about a fixed axle, with a drive.
std::string arm(const std::string& drive) {
  return R"yaml(
nodes: {arm: {position: [0, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 1, inertia: [0.3, 0.3, 0.5]}}
joints: {axle: {type: hinge, nodes: [ground, arm], axis: [0, 0, 1]}}
drives: {motor: {joint: axle, )yaml" +
         drive + "}}\n";
}

/// Returns angle and drive torque as they are recorded.
std::pair<double, double> recorded(const ReadyModel& model, const State& state) {
  double joint[16], torque[1];
  const auto& members = model.file.model.members();
  members[1].component->write_output(LocalState(state, model.system.slots()[1], model.environment()), joint);
  members[2].component->write_output(LocalState(state, model.system.slots()[2], model.environment()), torque);
  return {joint[0], torque[0]};
}

}  // namespace

TEST_CASE("an angle drive turns its joint as told, over many turns, and reports the torque J f''") {
  const ReadyModel model(arm("angle: \"40*t^2\""));
  const State state = integrate(model, Scheme::generalized_alpha(0.8), 1e-3, 1.0);
  const auto [angle, torque] = recorded(model, state);
  // Quadratic motion is exact for the scheme: 6.4 turns in one second.
  CHECK(angle == Approx(40).epsilon(1e-12));
  CHECK(torque == Approx(0.5 * 80).epsilon(1e-8));
}

TEST_CASE("a rate drive turns its joint at the given rate") {
  const ReadyModel model(arm("rate: \"3 + 2*t\""));
  const State state = integrate(model, Scheme::generalized_alpha(0.8), 1e-3, 1.0);
  const auto [angle, torque] = recorded(model, state);
  CHECK(model.node(state, "arm").Omega.z() == Approx(5).epsilon(1e-10));
  CHECK(angle == Approx(4).epsilon(1e-9));
  CHECK(torque == Approx(0.5 * 2).epsilon(1e-8));
}

TEST_CASE("a torque drive accelerates its joint") {
  const ReadyModel model(arm("torque: \"1.5\""));
  const State state = integrate(model, Scheme::generalized_alpha(0.8), 1e-3, 1.0);
  const auto [angle, torque] = recorded(model, state);
  CHECK(torque == 1.5);
  CHECK(angle == Approx(0.5 * 1.5 / 0.5).epsilon(1e-9));
}

TEST_CASE("drives by forces on one coordinate add, in any number") {
  const ReadyModel model(
      arm("torque: \"2.5\"}, second: {joint: axle, torque: -0.7}, third: {joint: axle, torque: \"-0.3\""));
  const State state = integrate(model, Scheme::generalized_alpha(0.8), 1e-3, 1.0);
  CHECK(recorded(model, state).first == Approx(0.5 * 1.5 / 0.5).epsilon(1e-9));
}

TEST_CASE("drives refuse what they cannot drive, in one sentence") {
  using Catch::Contains;
  const auto refuse = [](const std::string& drive) { ReadyModel model(arm(drive)); };
  CHECK_THROWS_WITH(
      refuse("displacement: \"t\""),
      Contains("a hinge joint has no displacement to drive: its coordinate 'angle' takes `angle`, `rate`, "
               "`torque`, `pid` or `motor`"));
  CHECK_THROWS_WITH(refuse("angle: \"t\", torque: \"1\""), Contains("one law"));
  CHECK_THROWS_WITH(refuse("angle: 1}, second: {joint: axle, torque: 2"),
                    Contains("the angle of joint 'axle' is driven by 'motor' already"));
  CHECK_THROWS_WITH(refuse("torque: 2}, second: {joint: axle, torque: 1}, third: {joint: axle, rate: 2"),
                    Contains("the angle of joint 'axle' is driven by 'motor' already"));
  CHECK_THROWS_WITH(refuse("angel: \"t\""), Contains("did you mean 'angle'"));
  CHECK_THROWS_WITH(refuse("angle: \"t*speeed\""), Contains("speeed"));
}
