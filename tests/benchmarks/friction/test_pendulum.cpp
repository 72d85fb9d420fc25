// A pendulum with friction in its bearing by its own reaction, against its equation for the angle, integrated piece by
// piece:
//
//     (I + m l^2) th'' = -m g l cos(th) - mu r |F| sign(th'),   F = m l (th'' e_t - th'^2 e_r) + m g e_y
// from one reversal to the next. It rests if m g l |cos(th)| <= mu_s r m g.
#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/runge_kutta.hpp"

using bielle::mechanism::Session;
using Catch::WithinAbs;

namespace test_pendulum {
namespace {

constexpr double m = 2, I = 0.05, l = 0.8, g = 9.81, mu = 0.3, mu_s = 0.4, r = 0.15;
constexpr double start = -0.3;  // initial angle from the horizontal

std::string pendulum() {
  return fmt::format(R"yaml(
gravity: [0, -9.81, 0]
nodes: {{bob: {{position: [{:.17g}, {:.17g}, 0]}}}}
elements: {{bob: {{type: rigid_body, node: bob, mass: 2, inertia: [0.05, 0.05, 0.05]}}}}
joints: {{pivot: {{type: hinge, nodes: [ground, bob], axis: [0, 0, 1], position: [0, 0, 0],
                 friction: {{model: stick_slip, coefficient: 0.3, static: 0.4, radius: 0.15}}}}}}
)yaml",
                     l * std::cos(start), l * std::sin(start));
}

using State = Eigen::Vector2d;

double force(double th, double w, double a) {
  const double t = m * l * a + m * g * std::cos(th), n = -m * l * w * w + m * g * std::sin(th);
  return std::hypot(t, n);
}

/// The fixed-point iteration contracts by mu r m l/(I + m l^2) = 0.05.
double acceleration(const State& z, double sign) {
  double a = 0;
  for (int k = 0; k < 20; ++k)
    a = (-m * g * l * std::cos(z[0]) - sign * mu * r * force(z[0], z[1], a)) / (I + m * l * l);
  return a;
}

/// Returns the angle at a time; turning points are located to rounding.
double reference(double end) {
  State z(start, 0);
  double t = 0, sign = -1;  // it begins to fall
  const double h = 1e-3;
  while (t < end) {
    const auto rate = [&](const State& y) -> State { return {y[1], acceleration(y, sign)}; };
    State next = z;
    double step = std::min(h, end - t);
    bielle::test::advance_by_runge_kutta(next, step, 4, rate);
    if (next[1] * sign >= 0) {
      z = next;
      t += step;
      continue;
    }
    double low = 0, high = step;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      next = z;
      bielle::test::advance_by_runge_kutta(next, middle, 4, rate);
      (next[1] * sign >= 0 ? low : high) = middle;
    }
    z[1] = 0;
    z[0] = next[0];
    t += high;
    if (std::abs(std::cos(z[0])) * l <= mu_s * r) return z[0];
    sign = -sign;
  }
  return z[0];
}

double angle(double h, double end) {
  double value = 0;
  bielle::test::move_to(pendulum(), h, end,
                        [&](const Session& session) { value = session.read("joints/pivot/coordinate")[0] + start; });
  return value;
}

}  // namespace

TEST_CASE("a pendulum with a rubbing bearing swings as its equation, to the second order, and comes to rest") {
  const double swinging = reference(4);
  const double coarse = angle(8e-3, 4) - swinging, middle = angle(4e-3, 4) - swinging, fine = angle(2e-3, 4) - swinging;
  CAPTURE(coarse, middle, fine);
  CHECK(std::log2(std::abs(coarse / middle)) == Approx(2).margin(0.1));
  CHECK(std::log2(std::abs(middle / fine)) == Approx(2).margin(0.1));
  CHECK(std::abs((4 * fine - middle) / 3) < 0.1 * std::abs(fine));
  // The final position depends on every swing before.
  const double rest = reference(100);
  CHECK(std::abs(std::cos(rest)) * l <= mu_s * r);
  CHECK_THAT(angle(2e-3, 30), WithinAbs(rest, 1e-4));
}

}  // namespace test_pendulum
