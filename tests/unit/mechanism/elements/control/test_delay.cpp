// Delayed measures: polynomials of the method of steps, and limits of stability.
#include <cmath>
#include <complex>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
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
  // With the kinks of the start the error depends on their positions within a step, and remains of second order.
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

TEST_CASE("a delayed position feeds an oscillator with energy beyond the gain of theory") {
  // q'' + c q' + w^2 q + k q(t - T) = 0: at the limit w^2 + k cos(W T) = W^2, k sin(W T) = c W.
  const double c = 1, W = 8, T = 0.1, k = c * W / std::sin(W * T), w2 = W * W - k * std::cos(W * T);
  const auto growth = [&](double gain) {
    Session session = session_of(rotor(
        fmt::format("parameters: {{k: {}, w2: {}, T: {}}}\n"
                    "drives: {{m: {{joint: main, torque: \"-0.5*(main.angle.rate + w2*main.angle + k*delay(main.angle, "
                    "T)) + if(t < 0.1, 1, 0)\"}}}}\n"
                    "measures: {{turned: main.angle}}\n",
                    gain, w2, T)));
    Motion motion = session.dynamics(steps_of(30, 0.0025));
    double early = 0, late = 0;
    while (motion.step()) {
      const double now = std::abs(session.read("measures/turned")[0]);
      if (motion.time() > 8 && motion.time() < 10) early = std::max(early, now);
      if (motion.time() > 28) late = std::max(late, now);
    }
    return std::log(late / early) / 20;
  };
  // The exponent s of the slow motion changes with the gain by ds/dk = -exp(-s T)/(2 s + c - k T exp(-s T)).
  const std::complex<double> s(0, W), z = std::exp(-s * T);
  const double slope = (-z / (2.0 * s + c - k * T * z)).real();
  for (const double change : {-0.05, 0.05}) {
    INFO("gain changed by " << change << " of the limit");
    CHECK(growth(k * (1 + change)) == Approx(slope * k * change).epsilon(0.1));
  }
  CHECK(std::abs(growth(k)) < 0.02 * slope * k);
}

TEST_CASE("a static analysis knows no delay") {
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
