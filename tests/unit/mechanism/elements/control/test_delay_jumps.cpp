// Jumps that delays bring back: steps end on them, so that motions between them are exact.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/hinged_rotor.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::rotor;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;

namespace test_delay_jumps {

/// Steps and their tolerances: they divide the times of the models or not.
const std::vector<std::pair<double, double>> kinds_of_steps = {
    {0.01, 0.0}, {0.1, 0.0}, {0.0173, 0.0}, {0.25, 0.0}, {0.01, 1e-6}};

double value(Session& session, const char* name) { return session.read(std::string("measures/") + name)[0]; }

/// Returns a relay u = sign x by events, and x' = -u(t - T) with x = T/2 at first: the slope changes its sign T after
/// each zero, up to which |x| has grown to T. So x oscillates between -T and T with the period 4 T, and falls through 0
/// at T/2.
std::string relay(double T) {
  return rotor(
      fmt::format("inputs: {{u: 1}}\n"
                  "states: {{x: {{rate: \"-delay(u, {})\", start: {}}}, area: {{rate: abs(x)}}}}\n"
                  "events:\n"
                  "  up: {{when: x, crosses: 0, direction: rising, once: false, do: [{{set: {{u: 1}}}}]}}\n"
                  "  down: {{when: x, crosses: 0, direction: falling, once: false, do: [{{set: {{u: -1}}}}]}}\n",
                  T, T / 2));
}

}  // namespace test_delay_jumps
using namespace test_delay_jumps;

TEST_CASE("a jump of a formula of time comes back after the delay, whatever the steps") {
  // The exact rate of `whole` is 1 up to t = 0.1234 + T and 0 after it.
  for (const double T : {0.25, 0.003, 0.4})
    for (const auto& [h, tolerance] : kinds_of_steps) {
      CAPTURE(T, h, tolerance);
      Session session =
          session_of(rotor(fmt::format("measures: {{switched: \"if(t < 0.1234, 1, 0)\"}}\n"
                                       "states: {{whole: {{rate: \"delay(switched, {})\"}}}}\n",
                                       T)));
      Motion motion = session.dynamics(steps_of(1, h, tolerance));
      REQUIRE(motion.finish());
      CHECK(value(session, "whole") == Approx(0.1234 + T).epsilon(1e-9));
    }
}

TEST_CASE("a relay with a delay oscillates with the delay as amplitude and four times the delay as period") {
  for (const double T : {0.25, 0.1, 0.0731})
    for (const auto& [h, tolerance] : kinds_of_steps) {
      CAPTURE(T, h, tolerance);
      Session session = session_of(relay(T));
      Motion motion = session.dynamics(steps_of(13 * T, h, tolerance));
      REQUIRE(motion.finish());
      // Events are located within 1e-10 of a step.
      CHECK(value(session, "x") == Approx(-T / 2).epsilon(1e-7));
    }
}

TEST_CASE("a sampled value comes back after the delay with all its jumps") {
  // u_k = k^2 at the instants 0.05 k: the integral of u(t - T) is a sum.
  for (const double T : {0.1, 0.07, 0.013})
    for (const auto& [h, tolerance] : kinds_of_steps) {
      CAPTURE(T, h, tolerance);
      Session session =
          session_of(rotor(fmt::format("states: {{u: {{sampled: \"(t/0.05)^2\", period: 0.05, start: 7}}, "
                                       "whole: {{rate: \"delay(u, {})\"}}}}\n",
                                       T)));
      Motion motion = session.dynamics(steps_of(1, h, tolerance));
      REQUIRE(motion.finish());
      double exact = 7 * T;  // before the motion, u had its start value
      for (int k = 0; 0.05 * k + T < 1 - 1e-9; ++k) exact += k * k * std::min(0.05, 1 - T - 0.05 * k);
      CHECK(value(session, "whole") == Approx(exact).epsilon(1e-9));
    }
}

TEST_CASE("an impulse comes back after the delay: a velocity that a lock has stopped") {
  // The rotor turns with 2 rad/s until a lock stops it at 0.5 rad.
  const double T = 0.15;
  for (const auto& [h, tolerance] : kinds_of_steps) {
    CAPTURE(h, tolerance);
    Session session = session_of(R"yaml(
nodes: {rotor: {position: [0, 0, 0]}}
elements: {rotor: {type: rigid_body, node: rotor, mass: 1, inertia: [0.3, 0.3, 0.5]}}
joints: {main: {type: hinge, nodes: [ground, rotor], axis: [0, 0, 1], start_rate: 2}}
events: {there: {when: main.angle, crosses: 0.5, direction: rising, do: [{lock: main}]}}
states: {turned: {rate: "delay(main.angle.rate, 0.15)"}, again: {rate: "delay(delay(main.angle.rate, 0.1), 0.05)"}}
)yaml");
    Motion motion = session.dynamics(steps_of(1, h, tolerance));
    REQUIRE(motion.finish());
    CHECK(value(session, "turned") == Approx(2 * T + 0.5).epsilon(1e-7));
    CHECK(value(session, "again") == Approx(2 * T + 0.5).epsilon(1e-7));
  }
}

TEST_CASE("an input that is set comes back after the delay, at the very step") {
  Session session = session_of(rotor("inputs: {u: 0}\nstates: {whole: {rate: \"delay(u, 0.2)\"}}\n"));
  Motion motion = session.dynamics(steps_of(1, 0.1));
  motion.advance_to(0.3);
  session.set_input("u", 3);
  motion.finish();
  CHECK(value(session, "whole") == Approx(3 * 0.5).epsilon(1e-9));
}

TEST_CASE("a motion goes on from a save between a jump and its return to the last bit") {
  for (const double tolerance : {0.0, 1e-6}) {
    const DynamicsOptions options = steps_of(3, 0.013, tolerance);
    Session session = session_of(relay(0.25));
    Motion motion = session.dynamics(options);
    motion.advance_to(0.75);  // a zero is at 0.625, its jump at 0.875
    const std::vector<double> saved = session.save();
    motion.finish();
    Session other = session_of(relay(0.25));
    Motion again = other.dynamics(options, saved);
    again.finish();
    CHECK(value(other, "x") == value(session, "x"));
    CHECK(value(other, "area") == value(session, "area"));
  }
}

TEST_CASE("a delay that cannot store all jumps ends the run with its cure") {
  Session session =
      session_of(rotor("states: {u: {sampled: t, period: 1e-4}, late: {delayed: u, time: 1, points: 40}, "
                       "whole: {rate: late}}\n"));
  Motion motion = session.dynamics(steps_of(1, 0.01));
  CHECK_THAT(bielle::test::message_of<ComputationError>([&] { motion.finish(); }),
             Contains("'late' cannot store all jumps of u over 1 s") && Contains("more `points`"));
}
