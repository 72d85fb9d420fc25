// Ropes with damping that slip: long steps, breaks, ropes that become taut, and the order of the error.
#include <algorithm>
#include <array>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"

using namespace bielle::mechanism;

namespace test_damped_rope_slip {
namespace {

constexpr double r = 0.1, J = 0.5, EA = 1e6, tau = 1e-3, F = 50;

/// Returns a band brake: the band is fixed at the anchor, passes half round the drum, and its other end is pulled by F.
/// @param rate  angular velocity of the drum: positive if it draws the band off the anchor's side [rad/s]
/// @param mass  mass of the pulled end [kg]
std::string band_brake(double rate, double mass, double mu, double damping) {
  return fmt::format(R"yaml(
nodes:
  anchor: {{position: [-1, 0.1, 0], fixed: true}}
  drum: {{fixed: [x, y, z, rx, ry], angular_velocity: [0, 0, {}]}}
  end: {{position: [-1, -0.1, 0], fixed: [y, z, rx, ry, rz]}}
elements:
  drum: {{type: rigid_body, node: drum, mass: 10, inertia: [0.5, 0.5, 0.5]}}
  end: {{type: point_mass, node: end, mass: {}}}
joints:
  band: {{type: cable, nodes: [anchor, drum, end], radii: [0, -0.1, 0], axis: [0, 0, 1], EA: 1e6, pretension: 50,
         friction: {}, damping: {}}}
loads: {{pull: {{node: end, force: [-50, 0, 0]}}}}
)yaml",
                     rate, mass, mu, damping);
}

struct Run {
  double rate = 0, slip = 0, end = 0;  ///< at the end: of the drum [rad/s], of the band [m], x of the pulled end [m]
  double dissipated = 0, error = 0;    ///< [J]; balance over the energy that flowed through or was stored
};

Run run(const std::string& text, double h, double duration, const std::string& rope) {
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  DynamicsOptions options;
  options.duration = duration;
  options.stepping.size = h;
  Motion motion = session.dynamics(options);
  motion.finish();
  const EnergyBalance& energy = motion.energy_balance();
  Run result;
  result.slip = session.read(fmt::format("joints/{}/slip", rope))[0];
  result.dissipated = energy.totals().dissipation;
  result.error = std::abs(motion.balance()) / std::max(energy.largest(), energy.through());
  if (rope != "band") return result;
  result.rate = session.node("drum").Omega.z();
  result.end = session.node("end").x.x();
  return result;
}

using Values = std::array<double, 5>;  // rotation and rate of the drum, x and velocity of the end, slip

/// Returns the rates by the equations of the releasing brake while it slips, T_1 = exp(-mu pi) T_2, with the small
/// resistance of rope_friction.hpp.
Values rates(const Values& y, double mass, double mu) {
  const auto [phi, omega, x, v, s] = y;
  const double a = std::exp(-mu * M_PI), E_0 = F / (EA + F), E_1 = E_0 - r * phi + s, E_2 = E_0 + r * phi - s - x;
  const double k_1 = EA / (1 - E_1), k_2 = EA / (1 - x - E_2);
  const double without_1 = k_1 * (E_1 - tau * r * omega), without_2 = k_2 * (E_2 + tau * (r * omega - v));
  const double slip_rate = (a * without_2 - without_1) / (tau * (k_1 + a * k_2) + 1e-10 * EA);
  const double T_1 = without_1 + tau * k_1 * slip_rate, T_2 = without_2 - tau * k_2 * slip_rate;
  return {omega, r * (T_1 - T_2) / J, v, (T_2 - F) / mass, slip_rate};
}

/// Runge and Kutta's method of fourth order.
Values integrated(Values y, double duration, int steps, double mass, double mu) {
  const double h = duration / steps;
  const auto moved = [](Values from, const Values& by, double factor) {
    for (std::size_t i = 0; i < from.size(); ++i) from[i] += factor * by[i];
    return from;
  };
  for (int k = 0; k < steps; ++k) {
    const Values k_1 = rates(y, mass, mu), k_2 = rates(moved(y, k_1, h / 2), mass, mu),
                 k_3 = rates(moved(y, k_2, h / 2), mass, mu), k_4 = rates(moved(y, k_3, h), mass, mu);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += h / 6 * (k_1[i] + 2 * k_2[i] + 2 * k_3[i] + k_4[i]);
  }
  return y;
}

}  // namespace

TEST_CASE("a damped band brake slows its drum by the capstan equation at long steps") {
  // J dw/dt = -r F (1 - exp(-mu pi)) in the releasing sense, and -r F (exp(mu pi) - 1) in the other.
  const double slow = 20 - r * F * (1 - std::exp(-0.3 * M_PI)) / J;
  for (const double h : {0.02, 5e-3, 1e-3}) {
    CAPTURE(h);
    const Run releasing = run(band_brake(20, 0.1, 0.3, tau), h, 1, "band");
    CHECK(releasing.rate == Approx(slow).epsilon(1e-3));
    // The first step contains the transient of the band, which the step does not resolve.
    CHECK(releasing.error < 1e-3 * std::max(1.0, h / 5e-3));
    const double tightened = 20 - r * F * (std::exp(0.3 * M_PI) - 1) / J;
    const Run tightening = run(band_brake(-20, 0.1, 0.3, tau), h, 1, "band");
    CHECK(-tightening.rate == Approx(tightened).epsilon(1e-2));
    CHECK(tightening.error < 5e-3);
  }
}

TEST_CASE("a band brake that bounces at long steps stops its drum with the energy of the drum") {
  for (const double h : {5e-3, 1e-3}) {
    CAPTURE(h);
    const Run stopped = run(band_brake(-20, 0.1, 1, tau), h, 0.5, "band");
    CHECK(std::abs(stopped.rate) < 1e-2);
    CHECK(stopped.dissipated == Approx(0.5 * J * 20 * 20).epsilon(5e-3));
    CHECK(stopped.error < 5e-3);
  }
}

TEST_CASE("a break of a load while a damped belt slips does not disturb the slip") {
  // The motor of 200 N m is switched off within 0.1 s after 1.5 s.
  const std::string text = R"yaml(
nodes: {motor: {fixed: [x, y, z, rx, ry]}, fan: {position: [0.6, 0, 0], fixed: [x, y, z, rx, ry]}}
elements:
  motor: {type: rigid_body, node: motor, mass: 1, inertia: [0.01, 0.01, 0.01]}
  fan: {type: rigid_body, node: fan, mass: 1, inertia: [0.2, 0.2, 0.2]}
joints:
  belt: {type: belt, nodes: [motor, fan], radii: [0.05, 0.15], axis: [0, 0, 1], EA: 5e4, pretension: 200, damping: 1e-3,
         friction: [0.3, ~]}
loads:
  m: {node: motor, moment: [0, 0, "20*min(t, 1)*(1 - step(t, 1.5, 1.6))"]}
  f: {node: fan, moment: [0, 0, "-0.2*fan.angular_velocity.z"]}
)yaml";
  const Run coarse = run(text, 8e-3, 2, "belt"), fine = run(text, 2e-3, 2, "belt");
  CHECK(coarse.error < 2e-3);
  CHECK(fine.error < 1e-5);
  CHECK(coarse.slip == Approx(fine.slip).epsilon(1e-2));
}

TEST_CASE("a slack rope with friction on two pulleys becomes taut") {
  const std::string text = R"yaml(
gravity: [0, 0, -9.81]
nodes:
  left: {position: [-0.1, 0, -1], fixed: [x, y, rx, ry, rz]}
  A: {fixed: true}
  B: {position: [1, 0, 0], fixed: [x, y, z, rx, rz]}
  right: {position: [1.1, 0, -1], fixed: [x, y, rx, ry, rz]}
elements:
  left: {type: point_mass, node: left, mass: 10}
  B: {type: rigid_body, node: B, mass: 1, inertia: [0.04, 0.04, 0.04]}
  right: {type: point_mass, node: right, mass: 5}
joints:
  rope: {type: cable, nodes: [left, A, B, right], radii: [0, 0.1, 0.1, 0], axis: [0, 1, 0], EA: 2e4, pretension: 60,
         damping: 2e-3, friction: [~, 0.2, 0.1, ~]}
loads: {r: {node: right, force: [0, 0, "-80*step(t, 0.1, 0.11) + 160*step(t, 0.3, 0.31) - 240*step(t, 0.6, 0.61)"]}}
)yaml";
  for (const double h : {5e-3, 1e-3}) {
    CAPTURE(h);
    const Run taut = run(text, h, 1, "rope");
    CHECK(std::isfinite(taut.slip));
    CHECK(taut.error < (h > 2e-3 ? 1e-2 : 2e-3));
  }
}

TEST_CASE("the slip of a damped rope has errors of second order") {
  const double mass = 20, mu = 0.3, duration = 0.064;
  const Values exact = integrated({0, 20, 0, 0, 0}, duration, 20000, mass, mu);
  const auto error = [&](double h) {
    const Run found = run(band_brake(20, mass, mu, tau), h, duration, "band");
    return std::array<double, 3>{std::abs(found.rate - exact[1]), std::abs(found.slip - exact[4]),
                                 std::abs(found.end + 1 - exact[2])};
  };
  const auto coarse = error(4e-3), fine = error(1e-3);
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    CAPTURE(i, coarse[i], fine[i]);
    CHECK(std::log2(coarse[i] / fine[i]) / 2 > 1.7);
  }
  CHECK(fine[1] < 1e-4 * std::abs(exact[4]));
}

}  // namespace test_damped_rope_slip
