// Drives that release their joints: at a time, at an event, when a measure crosses a value.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/describe_model.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/support/hinged_rotor.hpp"
#include "tests/support/second_order.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::rotor;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;

namespace test_release {
namespace {

constexpr double inertia = 0.5;

double angle(const Session& session) { return session.read("joints/main/coordinate")[0]; }
double rate(const Session& session) { return session.read("joints/main/rate")[0]; }
double torque(const Session& session) { return session.read("joints/main/drive_force")[0]; }

}  // namespace

TEST_CASE("after its release a joint moves freely, whatever has driven it") {
  // Up to 0.3137 s, which is not on a grid of steps, q = 4 t^2. After that the rate is constant.
  constexpr double s = 0.3137, end = 0.6;
  const std::string drive =
      GENERATE("angle: \"4*t^2\"", "rate: \"8*t\"", "torque: \"4\"", "pid: {target: \"4*t^2\", kp: 1e5, kd: 1e3}");
  const bool controlled = drive[0] == 'p';
  const double tolerance = GENERATE(0.0, 1e-7);
  CAPTURE(drive, tolerance);
  Session session = session_of(rotor("drives: {motor: {joint: main, " + drive + ", release: 0.3137}}\n"));
  Motion motion = session.dynamics(steps_of(end, 0.01, tolerance));
  motion.advance_to(0.3);
  CHECK(torque(session) == Approx(8 * inertia).epsilon(controlled ? 1e-2 : 1e-7));
  motion.advance_to(0.35);
  const double after = rate(session);
  CHECK(torque(session) == 0);
  motion.finish();
  CHECK(torque(session) == 0);
  CHECK(rate(session) == Approx(after).epsilon(1e-10));  // nothing acts
  // The controller lags by 8 J/kp = 4e-5 rad.
  CHECK(rate(session) == Approx(8 * s).epsilon(controlled ? 1e-3 : 1e-7));
  CHECK(angle(session) == Approx(4 * s * s + 8 * s * (end - s)).epsilon(controlled ? 1e-3 : 1e-7));
}

TEST_CASE("a drive lets go where a measure crosses a value, once") {
  // 1.5 N m up to 0.5 rad, to which a spring brings it back: the drive remains released.
  constexpr double turned = 0.5, w = std::sqrt(2 * 1.5 / inertia * turned);
  const std::string torque_drive = "drives: {motor: {joint: main, torque: 1.5, release: ";
  const std::string kind =
      GENERATE("{when: main.angle, crosses: 0.5, direction: rising}}}\n", "{when: \"2*main.angle - 1\"}}}\n",
               "{event: there}}}\nevents: {there: {when: main.angle, crosses: 0.5}}\n");
  CAPTURE(kind);
  for (const double h : {0.05, 0.013}) {
    Session session = session_of(rotor(torque_drive + kind));
    Motion motion = session.dynamics(steps_of(1, h));
    motion.finish();
    const double s = w * inertia / 1.5;  // the time of it
    CHECK(rate(session) == Approx(w).epsilon(1e-9));
    CHECK(angle(session) == Approx(turned + w * (1 - s)).epsilon(1e-9));
    CHECK(torque(session) == 0);
    CHECK_THAT(motion.last_event(), Contains("motor") || Contains("there"));
  }
  // The value is crossed back and forth.
  Session session = session_of(R"yaml(
nodes: {rotor: {position: [0, 0, 0]}}
elements: {rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [0.3, 0.3, 0.5]}}
joints: {main: {type: hinge, nodes: [ground, rotor], axis: [0, 0, 1], stiffness: 50}}
drives: {motor: {joint: main, torque: 20, release: {when: main.angle, crosses: 0.5}}}
)yaml");
  Motion motion = session.dynamics(steps_of(2, 0.005));
  motion.finish();
  CHECK(motion.log().crossings == 1);
  // The drive's work is half of 50 q^2 + 0.5 w^2: 20*0.5 J.
  CHECK(25 * angle(session) * angle(session) + 0.25 * rate(session) * rate(session) == Approx(10).epsilon(2e-3));
}

TEST_CASE("an angle drive that lets go of a swinging arm at an event leaves a pendulum") {
  const std::string text = R"yaml(
gravity: [0, -9.81, 0]
nodes: {arm: {position: [0.5, 0, 0]}}
elements: {arm: {type: rigid_body, node: arm, mass: 2, inertia: [0.1, 0.1, 0.1]}}
joints: {main: {type: hinge, nodes: [ground, arm], position: [0, 0, 0], axis: [0, 0, 1]}}
drives: {motor: {joint: main, angle: "0.2 + t", release: {when: main.angle, crosses: 0.5}}}
)yaml";
  // From 0.5 rad at 1 rad/s on: J q'' = -m g l cos q.
  const double J = 0.1 + 2 * 0.25, ml = 2 * 9.81 * 0.5, energy = J / 2 + ml * std::sin(0.5);
  bielle::test::check_second_order(
      [&](double h) {
        Session session = session_of(text);
        Motion motion = session.dynamics(steps_of(0.8, h));
        motion.finish();
        CHECK(torque(session) == 0);
        CHECK(angle(session) < 0.5);
        return Eigen::VectorXd::Constant(
            1, J / 2 * rate(session) * rate(session) + ml * std::sin(angle(session)) - energy);
      },
      0.004, 3);
}

TEST_CASE("a released drive stays so: after a restart, and in the analyses that follow") {
  const std::string text = R"yaml(
nodes: {rotor: {position: [0, 0, 0]}}
elements: {rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [0.3, 0.3, 0.5]}}
joints: {main: {type: hinge, nodes: [ground, rotor], axis: [0, 0, 1], stiffness: 50, rest: 0.1}}
drives: {motor: {joint: main, angle: "t", release: 0.25}}
)yaml";
  for (const double time : {0.2, 0.25, 0.3}) {
    CAPTURE(time);
    Session session = session_of(text);
    std::vector<double> saved;
    {
      Motion motion = session.dynamics(steps_of(0.4, 0.01));
      motion.advance_to(time);
      saved = session.save();
      motion.finish();
    }
    Session other = session_of(text);
    {
      Motion again = other.dynamics(steps_of(0.4, 0.01), saved);
      again.finish();
    }
    CHECK(angle(other) == angle(session));
    CHECK(rate(other) == rate(session));
    compute_statics(session, {});
    CHECK(angle(session) == Approx(0.1).epsilon(1e-9));  // place at which the spring is free
    Motion motion = session.dynamics(steps_of(0.1, 0.01));
    motion.finish();
    CHECK(angle(session) == Approx(0.1).epsilon(1e-8));
  }
}

TEST_CASE("a check says when drives let go, and their limits") {
  const auto said = [](const std::string& drive) {
    return describe_model(read_mechanism_text(rotor("drives: {motor: {joint: main, " + drive + "}}\n"), "model.yaml"));
  };
  CHECK_THAT(said("angle: t, release: 1.5"), Contains("lets go at 1.5 s"));
  CHECK_THAT(said("torque: t, limit: [~, 3], release: {when: main.angle, crosses: 2}"),
             Contains("at most 3") && Contains("lets go where main.angle crosses 2 rad"));
  CHECK_THAT(said("pid: {target: t, kp: 2, ki: 1, limit: 4}"),
             Contains("PID of t - angle: kp 2, ki 1, kd 0, tracking time 2 s, from -4 to 4"));
}

}  // namespace test_release
