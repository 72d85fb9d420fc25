// A door that is thrown against its stop, with friction in its hinge, against its own equation of motion: the stop is a
// rubber ball on the wall, or an end of the hinge.
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/benchmarks/contacts/contact_runs.hpp"
#include "tests/support/runge_kutta.hpp"

using namespace bielle::mechanism;
using namespace bielle::test;

namespace test_door {
namespace {

// The parts are the leaf, along x from the hinge when closed; the ball; the stop of the hinge; friction of the hinge
// and of the ball.
constexpr double m = 12, width = 0.8, half_thickness = 0.02, J = m * (0.8 * 0.8 + 0.04 * 0.04) / 12;
constexpr double ball_x = -0.1, ball_y = 0.7, ball = 0.03, k = 1e6, d = 0.3;
constexpr double stop_at = 1.5, stop_k = 2e4, stop_d = 60;
constexpr double hinge_mu = 0.3, hinge_r = 0.01, hinge_v = 1e-3, ball_mu = 0.5, ball_v = 0.05, spin = 1.2;

using Two = Eigen::Vector2d;

/// Pushes of the stop on the leaf: force [N] in the leaf's axes, moment about the hinge [N m].
struct Push {
  double x = 0, y = 0, moment = 0;
};

Push of_ball(double angle, double rate) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double x = c * ball_x + s * ball_y, y = -s * ball_x + c * ball_y;  // coordinates of the ball in the leaf's axes
  const double p = half_thickness + ball - y;
  if (p <= 0) return {};
  const double N = k * std::pow(p, 1.5) * std::max(0.0, 1 + d * x * rate);
  const double at = half_thickness - p / 2;  // halfway between the surfaces
  const double R = N * ball_mu * std::tanh(-at * rate / ball_v);
  return {-R, -N, -N * x + R * at};
}

Push of_hinge(double angle, double rate) {
  const double p = angle - stop_at;
  return {0, 0, p > 0 ? -std::max(0.0, stop_k * p + stop_d * rate) : 0};
}

/// The hinge carries the rest of the force: its friction depends on the acceleration that it slows.
Two rate_of(const Two& z, bool on_ball) {
  const Push push = on_ball ? of_ball(z[0], z[1]) : of_hinge(z[0], z[1]);
  double acceleration = 0;
  for (int n = 0; n < 100; ++n) {
    const Vector3 F(-m * width / 2 * z[1] * z[1] - push.x, m * width / 2 * acceleration - push.y, m * g);
    const double rub = hinge_mu * hinge_r * F.norm() * std::tanh(hinge_r * z[1] / hinge_v);
    const double next = (push.moment - rub) / (J + m * width * width / 4);
    if (std::abs(next - acceleration) <= 1e-14 * std::abs(next)) break;
    acceleration = next;
  }
  return {z[1], acceleration};
}

/// Returns the largest errors of the rate of a run, over its largest.
double error_of(bool on_ball, double h) {
  const std::string hinge = fmt::format(
      "  hinge: {{type: hinge, nodes: [ground, leaf], position: [0, 0, 0], axis: [0, 0, 1], friction: {{coefficient: "
      "{}, "
      "radius: {}, velocity: {}}}{}}}\n",
      hinge_mu, hinge_r, hinge_v,
      on_ball ? "" : fmt::format(", stops: {{range: [~, {}], stiffness: {}, damping: {}}}", stop_at, stop_k, stop_d));
  const std::string contact =
      on_ball ? fmt::format(
                    "  stop: {{type: contact, shapes: [{{node: leaf, box: [{}, {}, 2]}}, {{node: ground, sphere: "
                    "{}, at: [{}, {}, 0]}}], stiffness: {}, damping: {}, friction: {{coefficient: {}, velocity: "
                    "{}}}}}\n",
                    width, 2 * half_thickness, ball, ball_x, ball_y, k, d, ball_mu, ball_v)
              : "";
  const std::string text =
      contact_model({{"leaf",
                      fmt::format("position: [{}, 0, 0], velocity: [0, {:.17g}, 0], angular_velocity: [0, 0, {}]",
                                  width / 2, spin * width / 2, spin),
                      m,
                      {4.0016, 4.64, J}}},
                    hinge + contact, fmt::format("[0, 0, {}]", -g));
  // The damper of the hinge's stop acts at once: the short steps of the equation integrate over the jump.
  Two z(0, spin);
  double time = 0, worst = 0, deepest = 0, balance = 0;
  run_contact(text, {h, 1.6, 0, 0.9}, [&](const Session& session, const Motion& motion) {
    if (session.time() > time)
      advance_by_runge_kutta(z, session.time() - time, on_ball ? 8 : 100,
                             [&](const Two& at) { return rate_of(at, on_ball); });
    time = session.time();
    worst = std::max(worst, std::abs(session.read("joints/hinge/rate")[0] - z[1]));
    deepest = std::max(deepest, session.read("joints/hinge/coordinate")[0]);
    balance = std::max(balance, std::abs(motion.balance()));
  });
  CHECK(z[1] < -0.05);  // thrown back
  CHECK(deepest > 1.5);
  CHECK(balance < 1e-3);
  return worst / spin;
}

}  // namespace

TEST_CASE("a door that hits its stop moves as its equation says, with errors of second order") {
  for (const bool on_ball : {true, false}) {
    CAPTURE(on_ball);
    const double coarse = error_of(on_ball, 4e-4), fine = error_of(on_ball, 2e-4);
    CAPTURE(coarse, fine);
    CHECK(fine < 1e-3);
    CHECK(coarse / fine > 3);
  }
}

}  // namespace test_door
