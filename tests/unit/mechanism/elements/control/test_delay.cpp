// Delayed measures: polynomials of the method of steps, limits of stability, and the stored past itself.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/elements/control/value_history.hpp"
#include "tests/support/hinged_rotor.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/second_order.hpp"
#include "tests/support/session_model.hpp"

using namespace bielle;
using namespace bielle::mechanism;
using bielle::test::check_second_order;
using bielle::test::rotor;
using bielle::test::session_of;
using bielle::test::steps_of;
using Catch::Contains;

namespace test_delay {

/// y' = -y(t - T) with y = 1 up to t = 0, by the method of steps:  sum over k of (-1)^k (t - (k - 1) T)^k/k!
/// Reference: R. D. Driver, Ordinary and Delay Differential Equations, 1977, ch. 5.
double delayed_decay(double t, double T) {
  double sum = 1, factorial = 1;
  for (int k = 1; t - (k - 1) * T > 0; ++k) {
    factorial *= k;
    sum += (k % 2 == 0 ? 1 : -1) * std::pow(t - (k - 1) * T, k) / factorial;
  }
  return sum;
}

double last_value(const std::string& text, double duration, double h, const char* name, double tolerance = 0) {
  Session session = session_of(text);
  Motion motion = session.dynamics(steps_of(duration, h, tolerance));
  REQUIRE(motion.finish());
  return session.read(std::string("measures/") + name)[0];
}

std::string decay(double T) {
  return rotor(fmt::format("states: {{y: {{rate: \"-late\", start: 1}}, late: {{delayed: y, time: {}}}}}\n", T));
}

}  // namespace test_delay
using namespace test_delay;

TEST_CASE("the past of a value reproduces parabolas, within steps and beyond the last one") {
  const ValueHistory history(0.5, 20);
  VectorX memory = VectorX::Zero(static_cast<Eigen::Index>(history.memory_size()));
  const auto y = [](double t) { return 2 - 3 * t + 4 * t * t; };
  CHECK(history.before(0, memory).factor == 1);
  double t = 0, step = 0.03;
  for (int k = 0; k < 200; ++k, t += step, step = 0.03 + 0.02 * std::sin(k)) {
    history.store(t, y(t), memory);
    REQUIRE(history.knows(memory));
    if (k < 3) continue;
    const double h = 0.02, at = t + h - 0.5;
    const ValueHistory::Past past = history.before(t + h, memory);
    CHECK(past.factor == 0);
    CHECK(past.constant == Approx(at < 0 ? y(0) : y(at)).epsilon(1e-10));
    const ValueHistory::Past within = history.before(t + 0.7, memory);  // a step longer than the delay
    CHECK(within.constant + within.factor * y(t + 0.7) == Approx(y(t + 0.2)).epsilon(1e-10));
    CHECK(within.factor > 0);
  }
}

TEST_CASE("the past of a value has a fixed size for any steps, and forgets what comes later") {
  const ValueHistory history(1, 50);
  VectorX memory = VectorX::Zero(static_cast<Eigen::Index>(history.memory_size()));
  double t = 0, worst = 0;
  for (int k = 0; k < 20000; ++k, t += k % 3 == 0 ? 1e-9 : 3e-4) {
    history.store(t, std::sin(t), memory);
    REQUIRE(history.knows(memory));
    if (k % 100 == 0 && t > 1) worst = std::max(worst, std::abs(history.before(t, memory).constant - std::sin(t - 1)));
  }
  CHECK(worst > 0);
  CHECK(worst < 1e-5);  // (1/50)^3, times 1/12 and less
  history.store(t - 0.5, 7, memory);
  CHECK(history.knows(memory));
  CHECK(history.before(t - 0.5 + 1, memory).constant == Approx(7).epsilon(1e-12));
}

TEST_CASE("a delay differential equation is solved with second order, whatever the ratio of delay and step") {
  const double T = 1;
  check_second_order(
      [&](double h) { return Eigen::VectorXd::Constant(1, last_value(decay(T), 3.5, h, "y") - delayed_decay(3.5, T)); },
      0.1, 3);
  CHECK(last_value(decay(T), 3.5, 1e-4, "y", 1e-8) == Approx(delayed_decay(3.5, T)).margin(std::pow(1e-8, 2.0 / 3)));
  // The delay is shorter than the first steps, and no multiple of any: y = 1 + t^4 from t = 0 on, without a kink.
  const std::string smooth = rotor(
      "states: {y: {rate: \"4*t^3 + 1 + max(t - 0.0317, 0)^4 - late\", start: 1}, late: {delayed: y, time: 0.0317}}\n");
  check_second_order([&](double h) { return Eigen::VectorXd::Constant(1, last_value(smooth, 1, h, "y") - 2); }, 0.1, 4);
  // With the kinks of the start the error depends on where they lie in a step, and remains of second order.
  for (const double h : {0.1, 0.05, 0.025, 0.0125, 0.00625})
    CHECK(std::abs(last_value(decay(0.0317), 1, h, "y") - delayed_decay(1, 0.0317)) < 0.05 * h * h);
}

TEST_CASE("a delay within a step has its derivative: stiff equations converge, and are stable as theory says") {
  // y' = -50 y(t - 0.01) decays (50 * 0.01 < pi/2); without the derivative Newton's method would not converge.
  Session session = session_of(rotor("states: {y: {rate: \"-50*late\", start: 1}, late: {delayed: y, time: 0.01}}\n"));
  Motion motion = session.dynamics(steps_of(5, 0.1));
  motion.finish();
  CHECK(motion.log().most_iterations <= 4);
  CHECK(motion.log().refused_by_newton == 0);
  CHECK(std::abs(session.read("measures/y")[0]) < 1e-3);
}

TEST_CASE("delayed damping makes an oscillator unstable beyond the delay of theory") {
  // q'' + c q'(t - T) + w^2 q = 0: at the limit W T = pi/2, W^2 - c W - w^2 = 0.
  const double c = 2, w = 10, W = c / 2 + std::sqrt(c * c / 4 + w * w), limit = M_PI / (2 * W);
  const auto growth = [&](double T) {
    Session session = session_of(rotor(
        fmt::format("states: {{late: {{delayed: main.angle.rate, time: {}}}}}\n"
                    "drives: {{m: {{joint: main, torque: \"-0.5*(2*late + 100*main.angle) + if(t < 0.1, 1, 0)\"}}}}\n"
                    "measures: {{turned: main.angle}}\n",
                    T)));
    Motion motion = session.dynamics(steps_of(30, 0.005));
    double early = 0, late = 0;
    while (motion.step()) {
      double& largest = motion.time() < 10 ? early : late;
      if (motion.time() > 8) largest = std::max(largest, std::abs(session.read("measures/turned")[0]));
      if (motion.time() > 10 && motion.time() < 28) late = 0;
    }
    return late / early;
  };
  CHECK(growth(0.95 * limit) < 0.7);
  CHECK(growth(1.05 * limit) > 1.4);
}

TEST_CASE("kinks of a delayed measure come back after the delay, and a static analysis knows no delay") {
  const std::string text = rotor(
      "states: {late: {delayed: switched, time: 0.25}, whole: {rate: late}}\n"
      "measures: {switched: \"if(t < 0.1234, 1, 0)\"}\n");
  // The past is a ramp over the step that follows the jump; its integral is that of the values.
  CHECK(last_value(text, 1, 0.01, "whole") == Approx(0.25 + 0.1234).margin(0.01));
  Session session =
      session_of(rotor("states: {late: {delayed: main.angle, time: 0.25}}\n"
                       "drives: {m: {joint: main, torque: \"5 - 20*late\"}}\n"));
  compute_statics(session, {});
  CHECK(session.read("measures/late")[0] == Approx(0.25).epsilon(1e-9));
  Motion motion = session.dynamics(steps_of(1, 0.01));
  motion.finish();
  CHECK(session.read("measures/late")[0] == Approx(0.25).epsilon(1e-8));
}

TEST_CASE("a motion with delays goes on from a save to the last bit") {
  const std::string text = decay(0.0317) + "measures: {both: late + y}\n";
  for (const double tolerance : {0.0, 1e-6}) {
    const DynamicsOptions options = steps_of(1, 0.005, tolerance);
    Session session = session_of(text);
    Motion motion = session.dynamics(options);
    motion.advance_to(0.5);
    const std::vector<double> saved = session.save();
    motion.finish();
    Session other = session_of(text);
    Motion again = other.dynamics(options, saved);
    again.finish();
    CHECK(other.read("measures/both") == session.read("measures/both"));
  }
}

TEST_CASE("wrong delays are refused with a sentence") {
  const auto message = [](const std::string& keys) {
    return bielle::test::message_of<InputError>([&] { session_of(rotor("states: {held: {" + keys + "}}\n")); });
  };
  CHECK_THAT(message("delayed: main.angle"), Contains("states.held") && Contains("time"));
  CHECK_THAT(message("delayed: main.angle, time: 0"), Contains("time") && Contains("greater than 0"));
  CHECK_THAT(message("delayed: main.angle, time: -1"), Contains("time") && Contains("greater than 0"));
  CHECK_THAT(message("delayed: main.angle, time: 1, points: 2"), Contains("points") && Contains("between 4"));
  CHECK_THAT(message("delayed: main.angel, time: 1"), Contains("did you mean 'angle'"));
  CHECK_THAT(message("delayed: held, time: 1"), Contains("refers to itself"));
  CHECK_THAT(message("delayed: 2, time: 1"), Contains("a constant belongs to `parameters`"));
}
