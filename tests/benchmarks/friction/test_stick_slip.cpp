// A mass on a moving belt, held by a spring: closed form of its sticking and slipping with Coulomb's law.
//
//     sticks: moves with the belt, V, until k x = mu_s m g
//     slips:  m x'' + k x = mu_k m g: about x_k = mu_k m g/k with (x, x') from (x_s, V) until x' = V again, after
//             t_s = 2 (pi - atan((x_s - x_k) omega/V))/omega, at x = 2 x_k - x_s
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/runge_kutta.hpp"

using bielle::mechanism::Session;
using bielle::test::move;

namespace test_stick_slip {
namespace {

constexpr double m = 1, k = 100, V = 0.1, mu_s = 0.4, mu_k = 0.25, g = 9.81, omega = 10;
constexpr double x_s = mu_s * m * g / k, x_k = mu_k * m * g / k;

/// @param friction  model of the contact
std::string on_belt(const std::string& friction) {
  return R"yaml(
gravity: [0, 0, -9.81]
nodes:
  belt: {position: [0, 0, 0], velocity: [0.1, 0, 0]}
  anchor: {position: [-5, 0, 0], fixed: true}
  block: {position: [0, 0, 0], velocity: [0.1, 0, 0]}
elements:
  block: {type: rigid_body, node: block, mass: 1, inertia: [0.1, 0.1, 0.1]}
  spring: {type: spring_damper, nodes: [anchor, block], stiffness: 100}
joints:
  rail: {type: prismatic, nodes: [ground, belt], axis: [1, 0, 0]}
  contact: {type: prismatic, nodes: [belt, block], axis: [1, 0, 0], friction: {)yaml" +
         friction + R"yaml(}}
drives: {belt: {joint: rail, displacement: "0.1*t"}}
)yaml";
}

/// Returns the position and velocity at a time, from x = 0 at time 0, when it moves with the belt.
Eigen::Vector2d reference(double t) {
  const double sticks_first = x_s / V, slips = 2 * (M_PI - std::atan((x_s - x_k) * omega / V)) / omega;
  const double sticks = 2 * (x_s - x_k) / V;
  if (t < sticks_first) return {V * t, V};
  t = std::fmod(t - sticks_first, slips + sticks);
  if (t > slips) return {2 * x_k - x_s + V * (t - slips), V};
  const double c = std::cos(omega * t), s = std::sin(omega * t);
  return {x_k + (x_s - x_k) * c + V / omega * s, -(x_s - x_k) * omega * s + V * c};
}

}  // namespace

TEST_CASE("a mass on a belt sticks and slips as the closed form, to the second order over five periods") {
  const auto error = [](double h) -> Eigen::VectorXd {
    Eigen::VectorXd last(2), largest = Eigen::VectorXd::Zero(2);
    move(on_belt("model: stick_slip, coefficient: 0.25, static: 0.4"), h, 4.4, [&](const Session& session) {
      const auto& block = session.node("block");
      last = Eigen::Vector2d(block.x.x(), block.v.x()) - reference(session.time());
      largest = largest.cwiseMax(last.cwiseAbs());
    });
    return largest;
  };
  const Eigen::VectorXd coarse = error(8e-3), middle = error(4e-3), fine = error(2e-3);
  CAPTURE(coarse.transpose(), middle.transpose(), fine.transpose());
  CHECK(fine[0] < 5e-4 * x_s);
  for (int i = 0; i < 2; ++i) {
    CHECK(std::log2(coarse[i] / middle[i]) > 1.8);
    CHECK(std::log2(middle[i] / fine[i]) > 1.8);
  }
}

// With bristles: x'' = (F - k x)/m, F = m g (sigma_0 z + sigma_1(s) z' + sigma_2 v), v = V - x', and z' by the law.
TEST_CASE("with bristles the mass on the belt follows the equations of their law") {
  constexpr double sigma_0 = 500, sigma_1 = 8, sigma_2 = 0.02, v_s = 0.05;
  using State = Eigen::Vector3d;  // x, x', z
  const auto rate = [](const State& y) -> State {
    const double v = V - y[1], s = std::abs(v), mu = mu_k + (mu_s - mu_k) * std::exp(-(v / v_s) * (v / v_s));
    const double zdot = v - sigma_0 * s * y[2] / mu, c = sigma_1 / (4 * mu_k);
    const double F = m * g * (sigma_0 * y[2] + sigma_1 / std::sqrt(1 + c * c * s * s) * zdot + sigma_2 * v);
    return {y[1], (F - k * y[0]) / m, zdot};
  };
  const std::string text = on_belt(
      "model: lugre, coefficient: 0.25, static: 0.4, stribeck_velocity: 0.05, viscous: 0.02, bristle_stiffness: 500, "
      "bristle_damping: 8");
  const auto error = [&](double h) -> Eigen::VectorXd {
    State reference(0, V, 0);
    Eigen::VectorXd largest = Eigen::VectorXd::Zero(2);
    double before = 0;
    move(text, h, 1.2, [&](const Session& session) {
      bielle::test::advance_by_runge_kutta(reference, session.time() - before, 200, rate);
      before = session.time();
      const auto& block = session.node("block");
      largest = largest.cwiseMax(Eigen::Vector2d(block.x.x() - reference[0], block.v.x() - reference[1]).cwiseAbs());
    });
    return largest;
  };
  const Eigen::VectorXd coarse = error(2e-3), middle = error(1e-3), fine = error(5e-4);
  CAPTURE(coarse.transpose(), middle.transpose(), fine.transpose());
  for (int i = 0; i < 2; ++i) {
    CHECK(std::log2(coarse[i] / middle[i]) > 1.8);
    CHECK(std::log2(middle[i] / fine[i]) > 1.8);
  }
}

}  // namespace test_stick_slip
