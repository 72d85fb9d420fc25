// States in static analyses: rates are zero if that determines the states; states that are not determined do not
// change.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/session/notes.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;

namespace {

/// Returns an arm of 2 kg, its centre 0.5 m from its horizontal axle, drawn along x.
std::string arm(const std::string& more) {
  return R"yaml(
gravity: [0, -9.81, 0]
nodes: {arm: {position: [0.5, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {main: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 0, 1]}}
)yaml" + more;
}

struct Told final : Notes {
  std::string all;
  void note(const std::string& sentence) override { all += sentence + "\n"; }
};

const std::string integral_control = R"yaml(
states:
  total: {rate: "0.4 - main.angle", scale: 0.1}
  seen: {filter: main.angle, frequency: 5}
drives: {motor: {joint: main, torque: "30*(0.4 - seen) + 50*total - 4*main.angle.rate"}}
)yaml";
const double holding = 2 * 9.81 * 0.5 * std::cos(0.4);  // [N m]

}  // namespace

TEST_CASE("in statics a controller's integral is what keeps the joint at its target") {
  Session session = session_of(arm(integral_control));
  Told told;
  session.set_notes(&told);
  StaticsOptions options;
  options.steps = 3;
  compute_statics(session, options);
  CHECK(session.read("joints/main/coordinate")[0] == Approx(0.4).epsilon(1e-9));
  CHECK(session.read("measures/seen")[0] == Approx(0.4).epsilon(1e-9));
  CHECK(session.read("measures/total")[0] == Approx(holding / 50).epsilon(1e-8));
  CHECK(told.all.empty());
  // No state changes from there on.
  Motion motion = session.dynamics(steps_of(0.5, 0.01));
  motion.finish();
  CHECK(session.read("joints/main/coordinate")[0] == Approx(0.4).epsilon(1e-8));
  CHECK(session.read("measures/total")[0] == Approx(holding / 50).epsilon(1e-7));
}

TEST_CASE("a motion that starts in equilibrium starts with its states there") {
  Session session = session_of(arm(integral_control));
  DynamicsOptions options = steps_of(0.2, 0.01);
  options.equilibrium = true;
  Motion motion = session.dynamics(options);
  CHECK(session.read("measures/total")[0] == Approx(holding / 50).epsilon(1e-8));
  CHECK(motion.start().held.empty());
  motion.finish();
  CHECK(session.read("joints/main/coordinate")[0] == Approx(0.4).epsilon(1e-8));
}

TEST_CASE("what rates of zero do not determine stays as it was, and is told") {
  std::string text = arm(R"yaml(
states:
  way: {rate: main.angle, start: 0.3}
  clock: {rate: 1, start: 2}
  turned: {rate: main.angle.rate, start: 0.1}
  chained: {rate: way, start: 0.7}
  seen: {filter: "2*main.angle", time_constant: 0.1}
  low: {rate: "high"}
  high: {rate: "-low - high + 3*main.angle"}
)yaml");
  const std::string axis = "axis: [0, 0, 1]";
  text.replace(text.find(axis), axis.size(), axis + ", stiffness: 40");
  Session session = session_of(text);
  Told told;
  session.set_notes(&told);
  compute_statics(session, {});
  const auto value = [&](const char* name) { return session.read(std::string("measures/") + name)[0]; };
  const double angle = session.read("joints/main/coordinate")[0];
  CHECK(40 * angle == Approx(-2 * 9.81 * 0.5 * std::cos(angle)).epsilon(1e-9));
  CHECK(value("way") == 0.3);
  CHECK(value("clock") == 2);
  CHECK(value("turned") == 0.1);
  CHECK(value("chained") == 0.7);
  CHECK(value("seen") == Approx(2 * angle).epsilon(1e-9));
  CHECK(value("low") == Approx(3 * angle).epsilon(1e-9));
  CHECK(value("high") == Approx(0).margin(1e-9));
  CHECK_THAT(told.all, Contains("does not determine value of state 'way', value of state 'clock', value of state "
                                "'turned', value of state 'chained'") &&
                           Contains("stay as they were"));
  CHECK_THAT(told.all, !Contains("'seen'") && !Contains("'low'") && !Contains("'high'"));
}

TEST_CASE("a path of equilibria takes states along") {
  // A dead load on a spring, seen by a filter that drives a second, weaker spring against it: 40 q + 10 s = F, s = q.
  std::string text = arm(R"yaml(
states: {seen: {filter: main.angle, time_constant: 0.1}}
loads: {push: {node: arm, moment: [0, 0, 12]}}
drives: {motor: {joint: main, torque: "-10*seen"}}
)yaml");
  text.replace(text.find("gravity: [0, -9.81, 0]"), 22, "gravity: [0, 0, 0]");
  const std::string axis = "axis: [0, 0, 1]";
  text.replace(text.find(axis), axis.size(), axis + ", stiffness: 40");
  Session session = session_of(text);
  StaticsOptions options;
  options.steps = 0;
  options.path.emplace();
  options.path->end.load_factor = 1;
  compute_statics(session, options);
  CHECK(session.read("joints/main/coordinate")[0] == Approx(12.0 / 50).epsilon(1e-8));
  CHECK(session.read("measures/seen")[0] == Approx(12.0 / 50).epsilon(1e-8));
}
