// Sampled controllers: exact maps from instant to instant, whatever the steps, and continuation of a saved motion.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/analyses/kinematics.hpp"
#include "tests/support/hinged_rotor.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::rotor;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;

namespace test_sampled {

double held_value(Session& session, const std::string& name) { return session.read("measures/" + name)[0]; }

/// Returns a rotor of 0.5 kg m^2 under the torque u = -kp (q - 1) - kd q' of instants every T, from rest.
std::string controlled(const std::string& more, double kp = 20, double kd = 3) {
  return rotor("parameters: {kp: " + std::to_string(kp) + ", kd: " + std::to_string(kd) +
               "}\n"
               "states: {u: {sampled: \"-kp*(main.angle - 1) - kd*main.angle.rate\", period: 0.05" +
               more +
               "}}\n"
               "drives: {motor: {joint: main, torque: u}}\n"
               "measures: {turned: main.angle, speed: main.angle.rate}\n");
}

/// The exact motion between changes of the torque.
struct Rotor {
  double q = 0, w = 0;
  void move(double torque, double time) {
    const double a = torque / 0.5;
    q += w * time + a * time * time / 2;
    w += a * time;
  }
};

}  // namespace test_sampled
using namespace test_sampled;

TEST_CASE("a sampled controller moves a rotor as the exact map from instant to instant, whatever the steps") {
  constexpr double T = 0.05;
  for (const double delay : {0.0, 0.02, T})
    for (const double kd : {3.0, 22.0}) {  // the second one is unstable: kd T/J > 2
      Rotor exact;
      double held = 0, next = 0;
      for (int k = 0; k < 10; ++k) {
        next = -20 * (exact.q - 1) - kd * exact.w;
        if (delay == 0) held = next;
        exact.move(held, delay);
        if (delay > 0 && delay < T) held = next;
        exact.move(held, T - delay);
        if (delay == T) held = next;
      }
      // Steps that divide the period, the period itself, a multiple of it, others, adaptive ones.
      for (const auto& [h, tolerance] : {std::pair{0.01, 0.0}, {0.05, 0.0}, {0.1, 0.0}, {0.0173, 0.0}, {0.01, 1e-6}}) {
        CAPTURE(delay, kd, h, tolerance);
        Session session = session_of(controlled(", delay: " + std::to_string(delay), 20, kd));
        Motion motion = session.dynamics(steps_of(10 * T, h, tolerance));
        REQUIRE(motion.finish());
        CHECK(held_value(session, "turned") == Approx(exact.q).epsilon(1e-9));
        CHECK(held_value(session, "speed") == Approx(exact.w).epsilon(1e-9));
      }
    }
}

TEST_CASE("a controller whose outputs wait for several periods moves a rotor as the exact map") {
  constexpr double T = 0.05;
  constexpr int periods = 30;
  for (const double delay : {1.4 * T, 2 * T, 3 * T, 3.7 * T}) {
    Rotor exact;
    std::vector<double> samples;
    double held = 0, time = 0;
    // Instants n*T take samples, instants n*T + delay put them out; at equal times the output comes first.
    std::size_t out = 0;
    while (time < periods * T - 1e-12) {
      const double sampled = static_cast<double>(samples.size()) * T, put = static_cast<double>(out) * T + delay;
      const double next = std::min({sampled, put, periods * T});
      exact.move(held, next - time);
      time = next;
      if (put < time + 1e-12) held = samples[out++];
      if (sampled < time + 1e-12 && time < periods * T - 1e-12) samples.push_back(-2 * (exact.q - 1) - 0.3 * exact.w);
    }
    CHECK(std::abs(exact.q) > 0.1);
    for (const auto& [h, tolerance] : {std::pair{0.01, 0.0}, {0.05, 0.0}, {0.0173, 0.0}, {0.01, 1e-6}}) {
      CAPTURE(delay, h, tolerance);
      Session session = session_of(controlled(", delay: " + std::to_string(delay), 2, 0.3));
      Motion motion = session.dynamics(steps_of(periods * T, h, tolerance));
      REQUIRE(motion.finish());
      CHECK(held_value(session, "turned") == Approx(exact.q).epsilon(1e-9));
      CHECK(held_value(session, "speed") == Approx(exact.w).epsilon(1e-9).margin(1e-9));
    }
  }
}

TEST_CASE("a delay of several periods is a chain of sampled states") {
  Session session = session_of(rotor(R"yaml(
drives: {m: {joint: main, angle: sin(3*t)}}
states:
  third: {sampled: second, period: 0.1, start: 7}
  second: {sampled: first, period: 0.1, start: 7}
  first: {sampled: main.angle, period: 0.1, delay: 0.1, start: 7}
  late: {sampled: main.angle, period: 0.1, delay: 0.3, start: 7}
  both: {sampled: [main.angle, 2], period: 0.1, delay: 0.3, start: [7, 5], state_space: {A: [[0]], B: [[0, 0]], C: [[0], [0]], D: [[1, 0], [0, 1]]}}
)yaml"));
  Motion motion = session.dynamics(steps_of(2, 0.05));
  while (motion.step()) {
    CAPTURE(motion.time());
    CHECK(held_value(session, "late") == held_value(session, "third"));
    CHECK(held_value(session, "both.y1") == held_value(session, "late"));
    CHECK(held_value(session, "both.y2") == (motion.time() < 0.32 ? 5 : 2));
  }
}

TEST_CASE("the account of energy is closed although the torque jumps at the instants") {
  // With constant torques the trapezoidal rule is exact for the power.
  Session session = session_of(controlled(", delay: 0.02"));
  Motion motion = session.dynamics(steps_of(0.3, 0.01));
  motion.finish();
  CHECK(std::abs(motion.energy().input) > 0.1);
  CHECK(std::abs(motion.balance()) < 1e-10);
}

TEST_CASE("steps that divide the period stay as they are") {
  for (const double h : {0.05, 0.025, 0.005, 0.05 / 3}) {
    Session session = session_of(controlled(", first: 0.1"));
    Motion motion = session.dynamics(steps_of(100, h));
    motion.advance_to(20);
    CHECK(motion.log().steps == std::lround(20 / h));
    CHECK(motion.log().smallest == Approx(h).epsilon(1e-9));
  }
}

TEST_CASE("a value is held from its first instant on, after its start") {
  Session session =
      session_of(rotor("drives: {m: {joint: main, angle: \"2*t\"}}\n"
                       "states: {held: {sampled: main.angle, period: 0.1, first: 0.25, start: -1}}\n"
                       "measures: {double: 2*held}\n"));
  Motion motion = session.dynamics(steps_of(1, 0.01));
  const std::vector<std::pair<double, double>> expected = {{0.25, -1},  {0.26, 0.5}, {0.35, 0.5},
                                                           {0.36, 0.7}, {0.85, 1.5}, {0.86, 1.7}};
  for (const auto& [time, held] : expected) {
    motion.advance_to(time);
    CAPTURE(time);
    CHECK(held_value(session, "held") == Approx(held).epsilon(1e-9));
    CHECK(held_value(session, "double") == Approx(2 * held).epsilon(1e-9));
  }
}

TEST_CASE("blocks of one instant act in the order of the file, as statements of a program") {
  Session session =
      session_of(rotor("drives: {m: {joint: main, angle: t}}\n"
                       "states:\n"
                       "  early: {sampled: late, period: 0.1, start: 7}\n"
                       "  count: {sampled: count + 1, period: 0.1}\n"
                       "  late: {sampled: 10*count, period: 0.1, start: 3}\n"));
  Motion motion = session.dynamics(steps_of(1, 0.05));
  CHECK(held_value(session, "early") == 3);
  CHECK(held_value(session, "count") == 1);
  CHECK(held_value(session, "late") == 10);
  motion.advance_to(0.35);
  CHECK(held_value(session, "early") == 30);
  CHECK(held_value(session, "count") == 4);
  CHECK(held_value(session, "late") == 40);
}

TEST_CASE("outputs are rounded to a quantum, then limited") {
  Session session =
      session_of(rotor("drives: {m: {joint: main, angle: \"2*t\"}}\n"
                       "states: {held: {sampled: main.angle - 1, period: 0.1, quantum: 0.3, limit: [-0.75, 0.5]}}\n"));
  Motion motion = session.dynamics(steps_of(1, 0.05));
  const std::vector<double> expected = {-0.75, -0.75, -0.6, -0.3, -0.3, 0, 0.3, 0.3, 0.5, 0.5};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    CAPTURE(k);
    motion.step();  // the row of an instant has the value before it
    CHECK(held_value(session, "held") == Approx(expected[k]).margin(1e-12));
    motion.step();
  }
}

TEST_CASE("a sampled PID controller answers a ramp as its closed form") {
  constexpr double h = 0.02, P = 3, I = 5, D = 0.7, T = 0.06;
  Session session =
      session_of(rotor("drives: {m: {joint: main, angle: \"4*t\"}}\n"
                       "states: {held: {sampled: main.angle, period: 0.02, pid: {kp: 3, ki: 5, kd: 0.7, "
                       "filter: 0.06}}}\n"));
  Motion motion = session.dynamics(steps_of(1, h / 2));
  for (int k = 0; k < 20; ++k) {
    motion.step();
    const double t = k * h, slope = 1 - std::pow(T / (T + h), k);
    CHECK(held_value(session, "held") == Approx(4 * (P * t + I * t * t / 2 + D * slope)).epsilon(1e-9).margin(1e-12));
    motion.step();
  }
}

TEST_CASE("the integral of a limited PID controller does not wind up") {
  // Input 1 up to 1 s, then -1: the output leaves its limit at the first instant of the other sign.
  Session session =
      session_of(rotor("states: {held: {sampled: \"if(t < 0.95, 1, -1)\", period: 0.1, pid: {kp: 0.1, ki: 2}, "
                       "limit: [-1, 1]}}\n"));
  Motion motion = session.dynamics(steps_of(2, 0.05));
  double sum = 0, before = 1;
  for (int k = 0; k < 20; ++k) {
    motion.step();
    const double e = k < 10 ? 1 : -1, change = 2 * 0.1 * (e + before) / 2;
    if (!(0.1 * e + sum + change > 1 && change > 0) && !(0.1 * e + sum + change < -1 && change < 0)) sum += change;
    before = e;
    CAPTURE(k);
    CHECK(held_value(session, "held") == Approx(std::clamp(0.1 * e + sum, -1.0, 1.0)).margin(1e-12));
    CHECK(std::abs(sum) < 1.3);
    if (k == 11) CHECK(held_value(session, "held") < 0.9);
    motion.step();
  }
}

TEST_CASE("a transfer function in z answers a step as its closed form, and so does its state space") {
  // b/(z - a), and the sum of the last two inputs.
  Session session = session_of(
      rotor("states:\n"
            "  one: {sampled: 1, period: 0.1, transfer_function: {numerator: [0.4], denominator: [1, -0.7]}}\n"
            "  two: {sampled: [1, t], period: 0.1, state_space: {A: [[0.7]], B: [[0.4, 0]], C: [[1], [0]], "
            "D: [[0, 0], [0, 1]]}}\n"
            "  fir: {sampled: one, period: 0.1, transfer_function: {numerator: [1, 1], denominator: [1, 0]}}\n"));
  Motion motion = session.dynamics(steps_of(1, 0.05));
  double before = 0;
  for (int k = 0; k < 10; ++k) {
    motion.step();
    const double exact = 0.4 * (1 - std::pow(0.7, k)) / 0.3;
    CHECK(held_value(session, "one") == Approx(exact).margin(1e-13));
    CHECK(held_value(session, "two.y1") == Approx(exact).margin(1e-13));
    CHECK(held_value(session, "two.y2") == Approx(0.1 * k).margin(1e-12));
    CHECK(held_value(session, "fir") == Approx(exact + before).margin(1e-13));
    before = exact;
    motion.step();
  }
}

TEST_CASE("a motion with sampled states goes on from a save to the last bit") {
  for (const auto& [delay, tolerance] : {std::pair{"0.03", 0.0}, {"0.03", 1e-6}, {"0.17", 0.0}, {"0.17", 1e-6}})
    for (const double at : {0.02, 0.2, 0.215, 0.23}) {
      CAPTURE(delay, at);
      const std::string text = controlled(std::string(", quantum: 0.01, delay: ") + delay);
      const DynamicsOptions options = steps_of(0.5, 0.005, tolerance);
      Session session = session_of(text);
      Motion motion = session.dynamics(options);
      motion.advance_to(at);
      const std::vector<double> saved = session.save();
      motion.finish();
      Session other = session_of(text);
      Motion again = other.dynamics(options, saved);
      again.finish();
      for (const char* name : {"u", "turned", "speed"}) CHECK(held_value(other, name) == held_value(session, name));
    }
}

TEST_CASE("instants go on from one motion to the next, and an overdue one is taken at its beginning") {
  const std::string text = rotor(
      "drives: {m: {joint: main, angle: t}}\n"
      "states: {held: {sampled: main.angle, period: 0.1, start: 9}}\n");
  Session session = session_of(text);
  session.dynamics(steps_of(0.25, 0.01)).finish();
  CHECK(held_value(session, "held") == Approx(0.2));
  {
    Motion motion = session.dynamics(steps_of(0.25, 0.01));
    CHECK(held_value(session, "held") == Approx(0.2));
    motion.advance_to(0.31);
    CHECK(held_value(session, "held") == Approx(0.3));
  }
  Session driven = session_of(text);
  KinematicsOptions kinematics;
  kinematics.duration = 0.33;
  kinematics.step = 0.01;
  compute_kinematics(driven, kinematics);
  CHECK(held_value(driven, "held") == 9);
  Motion motion = driven.dynamics(steps_of(0.2, 0.01));
  CHECK(held_value(driven, "held") == Approx(0.33));
  motion.advance_to(0.41);
  CHECK(held_value(driven, "held") == Approx(0.4));
}

TEST_CASE("an overdue sample waits from the last instant before it on") {
  Session session =
      session_of(rotor("drives: {m: {joint: main, angle: t}}\n"
                       "states: {held: {sampled: main.angle, period: 0.1, delay: 0.25, start: 9}}\n"));
  KinematicsOptions kinematics;
  kinematics.duration = 0.33;
  kinematics.step = 0.01;
  compute_kinematics(session, kinematics);
  Motion motion = session.dynamics(steps_of(0.6, 0.01));
  for (const auto& [time, held] : {std::pair{0.54, 9.0}, {0.56, 0.33}, {0.64, 0.33}, {0.66, 0.4}, {0.76, 0.5}}) {
    motion.advance_to(time);
    CAPTURE(time);
    CHECK(held_value(session, "held") == Approx(held).epsilon(1e-9));
  }
}

TEST_CASE("an event on a sampled value happens at its instant") {
  Session session =
      session_of(rotor("drives: {m: {joint: main, angle: t}}\n"
                       "states: {held: {sampled: main.angle, period: 0.1}}\n"
                       "events: {on: {when: held, crosses: 0.35, action: stop}}\n"));
  Motion motion = session.dynamics(steps_of(1, 0.03));
  motion.finish();
  CHECK(motion.time() == Approx(0.4).epsilon(1e-10));
}

TEST_CASE("a sampled value that is no number ends the motion and names the state") {
  const auto message = [](const std::string& keys) {
    Session session =
        session_of(rotor("drives: {m: {joint: main, angle: t}}\nstates: {r: {period: 0.1, " + keys + "}}\n"));
    Motion motion = session.dynamics(steps_of(1, 0.1));
    return bielle::test::message_of<ComputationError>([&] { motion.finish(); });
  };
  CHECK_THAT(message("sampled: \"exp(5000*main.angle)\""),
             Contains("states.r.sampled") && Contains("t = 0.1") && Contains("larger than anything"));
  // The states 0, 1, 1e60, 1e120, .. soon exceed all numbers.
  CHECK_THAT(message("sampled: [1], state_space: {A: [[1e60]], B: [[1]]}"),
             Contains("t = 0.7 s") && Contains("'r'") && Contains("not a finite number"));
}

TEST_CASE("wrong sampled states are refused with a sentence") {
  const auto message = [](const std::string& keys) {
    return bielle::test::message_of<InputError>([&] { session_of(rotor("states: {held: {" + keys + "}}\n")); });
  };
  CHECK_THAT(message("sampled: main.angle"), Contains("states.held") && Contains("period"));
  CHECK_THAT(message("sampled: main.angle, period: 0"), Contains("period") && Contains("at least 1e-09"));
  CHECK_THAT(message("sampled: main.angle, period: .nan"), Contains("period") && Contains("finite"));
  CHECK_THAT(message("sampled: main.angle, period: 1e-3, delay: 100.1"),
             Contains("states.held.delay") && Contains("more than 100000 samples") && Contains("at most 100 s"));
  CHECK(message("sampled: main.angle, period: 1e-3, delay: 100") == "(nothing thrown)");
  CHECK_THAT(message("sampled: main.angle, period: 1, delay: -0.5"), Contains("delay") && Contains("at least 0"));
  CHECK_THAT(message("sampled: main.angle, period: 1, delay: .nan"), Contains("delay") && Contains("finite"));
  CHECK_THAT(message("sampled: main.angle, period: 1, limit: [1, 1]"),
             Contains("limit") && Contains("lower limit first"));
  CHECK_THAT(message("sampled: [main.angle, 1], period: 1"), Contains("sampled") && Contains("state_space"));
  CHECK_THAT(message("sampled: main.angle, period: 1, pid: {}"),
             Contains("pid") && Contains("at least one of the gains"));
  CHECK_THAT(message("sampled: main.angle, period: 1, pid: {kp: 1}, state_space: {A: [[1]], B: [[1]]}"),
             Contains("expected one of `pid`"));
  CHECK_THAT(message("sampled: main.angle, period: 1, start: [1, 2]"), Contains("start") && Contains("a list of 1"));
  CHECK_THAT(message("sampled: main.angle, period: 1, transfer_function: {numerator: [1, 0], denominator: [2]}"),
             Contains("no power of z"));
  CHECK_THAT(message("sampled: main.angle, periode: 1"), Contains("did you mean 'period'"));
}

TEST_CASE("a sampled block that grows by itself is warned of, one that integrates is not") {
  const auto warnings = [](const std::string& law) {
    const MechanismFile file =
        read_mechanism_text(rotor("states: {u: {sampled: main.angle, period: 0.01, " + law + "}}\n"), "model.yaml");
    return file.warnings;
  };
  const auto first = [&](const std::string& law) {
    const std::vector<std::string> all = warnings(law);
    return all.empty() ? "" : all.front();
  };
  CHECK_THAT(first("transfer_function: {numerator: [1], denominator: [1, -1.2]}"),
             Contains("states.u.transfer_function.denominator") && Contains("a root of magnitude 1.2"));
  CHECK_THAT(first("transfer_function: {numerator: [1], denominator: [1, 0, 4]}"), Contains("a root of magnitude 2"));
  CHECK_THAT(first("state_space: {A: [[0.5, 1], [0, -3]], B: [[1], [0]]}"),
             Contains("states.u.state_space.A") && Contains("an eigenvalue of magnitude 3"));
  // The blocks are one and three integrators; leading zeros have no effect.
  CHECK(warnings("transfer_function: {numerator: [0.01, 0], denominator: [1, -1]}").empty());
  CHECK(warnings("transfer_function: {numerator: [1], denominator: [1, -3, 3, -1]}").empty());
  CHECK(warnings("transfer_function: {numerator: [0, 0, 0, 1], denominator: [0, 1, -0.5]}").empty());
  CHECK(warnings("pid: {kp: 1, ki: 100}").empty());
}

TEST_CASE("leading zeros of a sampled transfer function change nothing") {
  const auto value = [](const std::string& function) {
    Session session =
        session_of(rotor("states: {u: {sampled: \"1 + t\", period: 0.1, transfer_function: {" + function + "}}}\n"));
    Motion motion = session.dynamics(steps_of(1, 0.05));
    motion.finish();
    return held_value(session, "u");
  };
  const double u = value("numerator: [1, 0.3], denominator: [1, -0.5]");
  CHECK(u != 0);
  CHECK(value("numerator: [0, 0, 1, 0.3], denominator: [0, 1, -0.5]") == u);
}
