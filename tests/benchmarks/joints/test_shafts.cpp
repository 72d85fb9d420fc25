// Shafts joined by universal and constant-velocity joints.
//
// Closed form of the universal joint (bend b, theta_1 = 0 where the arm on the first shaft lies in the plane of both):
//     tan(theta_2) = tan(theta_1)/cos(b),   omega_2/omega_1 = cos(b)/(1 - sin(b)^2 cos(theta_1)^2)
// (H. C. Seherr-Thoss et al., Universal Joints and Driveshafts, 2nd ed., 2006, section 1.2). The free motion of two
// flywheels follows from the energy J_1 omega_1^2 + J_2 omega_2^2 (tests/references/universal_joint.py).
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/joints/moved.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/second_order.hpp"

using bielle::mechanism::Session;
using bielle::test::move;
using bielle::test::move_to;

namespace {

constexpr double b = M_PI / 6, J_1 = 0.01, J_2 = 0.02;

/// Returns the first shaft along z, the second bent towards x by b.
std::string cardan(const std::string& more) {
  return fmt::format(R"yaml(
nodes:
  s1: {{angular_velocity: [0, 0, 10]}}
  s2: {{angular_velocity: [{:.17g}, 0, {:.17g}]}}
elements:
  w1: {{type: rigid_body, node: s1, mass: 1, inertia: [0.01, 0.01, {}]}}
  w2: {{type: rigid_body, node: s2, mass: 1, inertia: [{}, {}, {}]}}
joints:
  in: {{type: hinge, nodes: [ground, s1], axis: [0, 0, 1]}}
  out: {{type: hinge, nodes: [ground, s2], axis: [{:.17g}, 0, {:.17g}]}}
  cross: {{type: universal, nodes: [s1, s2], axis: [1, 0, 0], second_axis: [0, 1, 0]}}
)yaml",
                     10 / std::cos(b) * std::sin(b), 10 / std::cos(b) * std::cos(b), J_1, J_2, J_2, J_2, std::sin(b),
                     std::cos(b)) +
         more;
}

double ratio(double theta_1) { return std::cos(b) / (1 - std::pow(std::sin(b) * std::cos(theta_1), 2)); }

}  // namespace

TEST_CASE("a driven universal joint has the fluctuation of its closed form, and counts turns") {
  move(cardan("drives: {motor: {joint: in, angle: 10*t}}\n"), 0.004, 2, [](const Session& session) {
    const double theta_1 = 10 * session.time();
    const double theta_2 = std::atan2(std::sin(theta_1), std::cos(theta_1) * std::cos(b));
    const double found = session.read("joints/out/coordinate")[0];
    CHECK(std::abs(std::remainder(found - theta_2, 2 * M_PI)) < 1e-9);
    CHECK(std::abs(found - theta_1) < 0.075);  // the lag is 4.12 degrees at most: it has counted its turns
    // Rates follow from exact positions: the remaining error is the scheme's.
    CHECK(session.read("joints/out/rate")[0] == Approx(10 * ratio(theta_1)).epsilon(2e-3));
  });
}

TEST_CASE("two flywheels on a universal joint move as their energy says, with order two") {
  const bielle::test::ReferenceTable exact("universal_joint");
  const auto error = [&](double h) {
    Eigen::VectorXd left(3);
    move_to(cardan(""), h, 2, [&](const Session& session) {
      left << session.read("joints/in/coordinate")[0] - exact("angle"),
          session.read("joints/in/rate")[0] - exact("first_rate"),
          session.read("joints/out/rate")[0] - exact("second_rate");
    });
    return left;
  };
  bielle::test::check_second_order(error, 0.004, 2);
}

TEST_CASE("the torque in a universal joint is that of the flywheel that it drives, with order two") {
  // omega_1 = 10 constant; at theta_1 = 45 degrees alpha_2 = -28.278380531737, and the power balance gives the motor's
  // torque J_2 alpha_2 omega_2/omega_1 = -0.55976676384840 N m.
  const auto error = [](double h) {
    Eigen::VectorXd left(1);
    move_to(cardan("drives: {motor: {joint: in, angle: \"10*t + pi/4 - 10*pi/40\"}}\n"), h, M_PI / 40,
            [&](const Session& session) { left << session.read("joints/in/drive_force")[0] + 0.55976676384840; });
    return left;
  };
  bielle::test::check_second_order(error, M_PI / 40 / 32, 2, 0.15);
}

TEST_CASE("two universal joints with parallel forks run evenly") {
  // Z-arrangement: the third shaft is parallel to the first, the forks of the middle shaft are parallel.
  const std::string text = fmt::format(R"yaml(
nodes:
  s1: {{}}
  s2: {{}}
  s3: {{position: [{0:.17g}, 0, {1:.17g}]}}
elements:
  w1: {{type: rigid_body, node: s1, mass: 1, inertia: [0.01, 0.01, 0.01]}}
  w2: {{type: rigid_body, node: s2, mass: 1, inertia: [0.01, 0.01, 0.01]}}
  w3: {{type: rigid_body, node: s3, mass: 1, inertia: [0.01, 0.01, 0.01]}}
joints:
  in: {{type: hinge, nodes: [ground, s1], axis: [0, 0, 1]}}
  out: {{type: hinge, nodes: [ground, s3], axis: [0, 0, 1]}}
  first: {{type: universal, nodes: [s1, s2], position: [0, 0, 0], axis: [1, 0, 0], second_axis: [0, 1, 0]}}
  second: {{type: universal, nodes: [s2, s3], axis: [0, 1, 0], second_axis: [1, 0, 0]}}
drives: {{motor: {{joint: in, angle: "3*t"}}}}
)yaml",
                                       std::sin(b), std::cos(b));
  move(text, 0.02, 3, [](const Session& session) {
    CHECK(session.read("joints/out/coordinate")[0] == Approx(3 * session.time()).margin(1e-9));
  });
}

TEST_CASE("a constant-velocity joint has equal angles to rounding, whatever the bend, also while it changes") {
  const std::string text = R"yaml(
nodes:
  s1: {}
  carrier: {}
  s2: {}
elements:
  w1: {type: rigid_body, node: s1, mass: 1, inertia: [0.01, 0.01, 0.02]}
  w2: {type: rigid_body, node: s2, mass: 1, inertia: [0.01, 0.01, 0.02]}
  arm: {type: rigid_body, node: carrier, mass: 1, inertia: [0.1, 0.1, 0.1]}
joints:
  in: {type: hinge, nodes: [ground, s1], axis: [0, 0, 1]}
  swing: {type: hinge, nodes: [ground, carrier], axis: [0.6, 0.8, 0]}
  out: {type: hinge, nodes: [carrier, s2], axis: [0, 0, 1]}
  rzeppa: {type: constant_velocity, nodes: [s1, s2], axis: [0, 0, 1]}
drives:
  motor: {joint: in, angle: "8*t"}
  bend: {joint: swing, angle: "2.6*sin(t)"}
)yaml";
  double largest = 0;
  move(text, 0.01, 4, [&](const Session& session) {
    CHECK(session.read("joints/out/coordinate")[0] == Approx(8 * session.time()).margin(1e-9));
    const std::vector<double> bend = session.read("joints/rzeppa/coordinate");
    CHECK(std::hypot(bend[0], bend[1]) == Approx(std::abs(2.6 * std::sin(session.time()))).margin(1e-9));
    largest = std::max(largest, std::hypot(bend[0], bend[1]));
  });
  CHECK(largest > 2.59);  // 148 degrees
}

TEST_CASE("a constant-velocity joint that is drawn bent knows its bend") {
  const std::string text = R"yaml(
nodes: {s1: {}, s2: {}}
elements:
  w1: {type: rigid_body, node: s1, mass: 1, inertia: [0.01, 0.01, 0.02]}
  w2: {type: rigid_body, node: s2, mass: 1, inertia: [0.01, 0.01, 0.02]}
joints:
  in: {type: hinge, nodes: [ground, s1], axis: [0, 0, 1]}
  out: {type: hinge, nodes: [ground, s2], axis: [0.6, 0, 0.8]}
  rzeppa: {type: constant_velocity, nodes: [s1, s2], axes: [[0, 0, 1], [0.6, 0, 0.8]]}
drives: {motor: {joint: in, angle: "8*t"}}
)yaml";
  move(text, 0.01, 2, [&](const Session& session) {
    CHECK(session.read("joints/out/coordinate")[0] == Approx(8 * session.time()).margin(1e-9));
    const std::vector<double> bend = session.read("joints/rzeppa/coordinate");
    CHECK(std::hypot(bend[0], bend[1]) == Approx(std::acos(0.8)).epsilon(1e-9));
  });
}
