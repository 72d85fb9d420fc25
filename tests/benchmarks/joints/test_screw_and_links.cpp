// Screws, links without a body, points on lines and planes: closed forms and minimal coordinates.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/runge_kutta.hpp"
#include "tests/support/second_order.hpp"

using bielle::mechanism::Session;
using bielle::test::move;
using bielle::test::move_to;
using Vector2 = Eigen::Vector2d;

TEST_CASE("a nut runs down a vertical screw with the acceleration of its closed form") {
  // m = 2 kg, J = 0.01 kg m^2, 0.1 m per turn: alpha = m g p/(J + m p^2), p = pitch/(2 pi); constant, so that the
  // scheme integrates it exactly.
  const double p = 0.1 / (2 * M_PI), alpha = 2 * 9.81 * p / (0.01 + 2 * p * p);
  const std::string text = R"yaml(
gravity: [0, 0, -9.81]
nodes: {nut: {position: [0.3, -0.2, 0.5]}}
elements: {body: {type: rigid_body, node: nut, mass: 2, inertia: [0.02, 0.02, 0.01]}}
joints: {thread: {type: screw, nodes: [ground, nut], axis: [0, 0, 1], pitch: 0.1}}
)yaml";
  move(text, 0.01, 1, [&](const Session& session) {
    const double t = session.time();
    const std::vector<double> c = session.read("joints/thread/coordinate"), f = session.read("joints/thread/reaction");
    CHECK(c[1] == Approx(-0.5 * alpha * t * t).margin(1e-9));
    CHECK(c[0] == Approx(c[1] * p).margin(1e-12));
    CHECK(session.node("nut").x.z() == Approx(0.5 + c[0]).margin(1e-12));
    CHECK(f[2] == Approx(2 * (9.81 - alpha * p)).epsilon(1e-8));
    CHECK(f[5] == Approx(-0.01 * alpha).epsilon(1e-8));
  });
}

TEST_CASE("a screw counts its turns, right-handed and left-handed") {
  for (const double pitch : {0.02, -0.02}) {
    const std::string text = fmt::format(R"yaml(
nodes: {{nut: {{}}}}
elements: {{body: {{type: rigid_body, node: nut, mass: 2, inertia: [0.02, 0.02, 0.01]}}}}
joints: {{thread: {{type: screw, nodes: [ground, nut], axis: [0, 1, 0], pitch: {}}}}}
drives: {{motor: {{joint: thread, angle: "40*pi*t"}}}}
)yaml",
                                         pitch);
    move(text, 0.005, 1, [&](const Session& session) {
      CHECK(session.node("nut").x.y() == Approx(20 * pitch * session.time()).margin(1e-11));
    });
  }
}

TEST_CASE("a pendulum on a rod that is drawn in swings as its minimal equation, with order two") {
  // theta from the vertical: theta'' = -(2 L' theta' + g sin(theta))/L, tension m (L theta'^2 + g cos(theta) - L'').
  struct Rod {
    double L, L1, L2;
  };
  const auto rod = [](double t) -> Rod {
    return {1.2 - 0.2 * t + 0.1 * std::sin(3 * t), -0.2 + 0.3 * std::cos(3 * t), -0.9 * std::sin(3 * t)};
  };
  using Vector3 = Eigen::Vector3d;  // theta, theta', t
  const auto rate = [&](const Vector3& z) -> Vector3 {
    const Rod r = rod(z[2]);
    return {z[1], -(2 * r.L1 * z[1] + 9.81 * std::sin(z[0])) / r.L, 1};
  };
  const double end = 1.6;
  Vector3 z(std::atan2(0.72, 0.96), 0, 0);
  bielle::test::advance_by_runge_kutta(z, end, 4000, rate);
  const Rod last = rod(end);
  const double tension = 2 * (last.L * z[1] * z[1] + 9.81 * std::cos(z[0]) - last.L2);
  // L' = 0.1 at the start, along the rod.
  const std::string text = R"yaml(
gravity: [0, 0, -9.81]
nodes: {bob: {position: [0.72, 0, -0.96], velocity: [0.06, 0, -0.08], fixed: [rx, ry, rz]}}
elements: {m: {type: point_mass, node: bob, mass: 2}}
joints: {rod: {type: distance, nodes: [ground, bob], length: "1.2 - 0.2*t + 0.1*sin(3*t)"}}
)yaml";
  const auto error = [&](double h) {
    Eigen::VectorXd left(3);
    move_to(text, h, end, [&](const Session& session) {
      const Eigen::Vector3d x = session.node("bob").x;
      CHECK(x.norm() == Approx(last.L).epsilon(1e-9));
      const std::vector<double> f = session.read("joints/rod/reaction_inertial");
      left << x.x() - last.L * std::sin(z[0]), x.z() + last.L * std::cos(z[0]),
          0.01 * (std::hypot(f[0], f[2]) - tension);
    });
    return left;
  };
  bielle::test::check_second_order(error, 0.02, 3, 0.15);
}

TEST_CASE("a ball on a hinged rod swings about the hinge's axis, inclined and off its plane") {
  // The ball keeps its distance from a point of the axis and its height along it: a pendulum of length rho in a plane
  // inclined by 60 degrees, theta'' = -g sin(60 deg)/rho sin(theta).
  const double incline = M_PI / 3, rho = 0.5, offset = 0.2;
  const Eigen::Vector3d axis(std::cos(incline), 0, std::sin(incline)), down(std::sin(incline), 0, -std::cos(incline));
  // (axis makes 60 degrees with the horizontal, so that gravity across it is g cos(60 deg).)
  const double g = 9.81 * std::cos(incline);
  const Eigen::Vector3d start = rho * Eigen::Vector3d::UnitY() + offset * axis;
  const std::string text = fmt::format(R"yaml(
gravity: [0, 0, -9.81]
nodes: {{ball: {{position: [{:.17g}, {:.17g}, {:.17g}], fixed: [rx, ry, rz]}}}}
elements: {{m: {{type: point_mass, node: ball, mass: 3}}}}
joints: {{rod: {{type: revolute_spherical, nodes: [ground, ball], axis: [{:.17g}, 0, {:.17g}]}}}}
)yaml",
                                       start.x(), start.y(), start.z(), axis.x(), axis.z());
  Vector2 z(M_PI / 2, 0);  // from `down`
  bielle::test::advance_by_runge_kutta(z, 1.1, 4000, [&](const Vector2& y) -> Vector2 {
    return {y[1], -g / rho * std::sin(y[0])};
  });
  const Eigen::Vector3d expected =
      offset * axis + rho * (std::cos(z[0]) * down + std::sin(z[0]) * Eigen::Vector3d::UnitY());
  const auto error = [&](double h) {
    Eigen::VectorXd left(4);
    move_to(text, h, 1.1, [&](const Session& session) {
      left.head<3>() = session.node("ball").x - expected;
      left[3] = std::abs(session.read("joints/rod/coordinate")[0]) - std::abs(z[0] - M_PI / 2);
    });
    return left;
  };
  bielle::test::check_second_order(error, 0.02, 3, 0.15);
}

TEST_CASE("beads slide on a line and on a plane as on slopes") {
  // Gravity along the line (0.6, 0, -0.8): 0.8 g; on the plane normal to it: 0.6 g along (-0.8, 0, -0.6).
  const std::string text = R"yaml(
gravity: [0, 0, -9.81]
nodes:
  bead: {position: [1, 2, 3], velocity: [0.6, 0, -0.8], fixed: [rx, ry, rz]}
  puck: {position: [1, 2, 3], velocity: [0, 2, 0], fixed: [rx, ry, rz]}
elements:
  m1: {type: point_mass, node: bead, mass: 3}
  m2: {type: point_mass, node: puck, mass: 2}
joints:
  wire: {type: point_on_line, nodes: [ground, bead], line: [0.6, 0, -0.8]}
  table: {type: point_on_plane, nodes: [ground, puck], normal: [0.6, 0, -0.8], second_axis: [0, 1, 0]}
)yaml";
  move(text, 0.02, 1, [](const Session& session) {
    const double t = session.time();
    CHECK(session.read("joints/wire/coordinate")[0] == Approx(t + 0.4 * 9.81 * t * t).epsilon(1e-9));
    CHECK(session.read("joints/wire/reaction_inertial")[2] == Approx(3 * 9.81 * 0.36).epsilon(1e-8));
    const std::vector<double> c = session.read("joints/table/coordinate");
    CHECK(c[0] == Approx(2 * t).epsilon(1e-9));
    CHECK(std::abs(c[1]) == Approx(0.3 * 9.81 * t * t).epsilon(1e-9));
    CHECK(session.read("joints/table/reaction")[2] == Approx(-2 * 9.81 * 0.8).epsilon(1e-8));
  });
}
