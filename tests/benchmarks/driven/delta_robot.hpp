// A delta robot: three arms of beams on motors, each with two rods between spherical joints, and a platform that moves
// without turning.
#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

namespace bielle::test {

constexpr double delta_base = 0.15, delta_arm = 0.3, delta_platform = 0.05, delta_gap = 0.05;  // [m]
constexpr double delta_rod = 0.7;                                                              // [m]
constexpr double delta_cross_mass = 0.05, delta_rod_mass = 0.06, delta_platform_mass = 0.5;    // [kg]

/// Returns the height of the platform below the motors with the arms level [m].
inline double delta_depth() {
  return std::sqrt(delta_rod * delta_rod - std::pow(delta_base + delta_arm - delta_platform, 2));
}

/// Returns the torque of each motor that holds the robot at rest with its arms level, counted as its drive counts it [N
/// m]: the arm's weight at its middle, that of its end and of half the rods, and of the platform's third with the other
/// halves, which the rods carry to the arm's end along their own direction.
inline double delta_torque_at_rest() {
  constexpr double g = 9.81;
  const double arm_mass = 2700 * 0.024 * 0.03 * delta_arm;
  const double at_end = delta_cross_mass + delta_rod_mass, hanging = delta_rod_mass + delta_platform_mass / 3;
  return -g * delta_arm * (arm_mass / 2 + at_end + hanging);
}

/// @param stiffer  times the stiffness of aluminium
inline std::string delta_robot(double stiffer) {
  std::string nodes, elements, joints, drives;
  const double depth = delta_depth(), reach = delta_base + delta_arm - delta_platform;
  for (int k = 0; k < 3; ++k) {
    const double c = std::cos(2 * M_PI * k / 3), s = std::sin(2 * M_PI * k / 3);
    // From the axes of an arm, x outwards and y along its motor, to inertial ones.
    const auto place = [&](double x, double y, double z) {
      return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", c * x - s * y, s * x + c * y, z);
    };
    const double end = delta_base + delta_arm;
    nodes += fmt::format("  hub_{0}: {{position: {1}}}\n  elbow_{0}: {{position: {2}}}\n", k + 1,
                         place(delta_base, 0, 0), place(end, 0, 0));
    elements += fmt::format(
        "  arm_{0}: {{type: beam, nodes: [hub_{0}, elbow_{0}], elements: 3, orientation: [0, 0, 1], section: "
        "{{rectangle: "
        "[0.03, 0.024], young: {1}, poisson: 0.33, density: 2700}}}}\n"
        "  cross_{0}: {{type: rigid_body, node: elbow_{0}, mass: {2}, inertia: [4e-5, 4e-5, 4e-5]}}\n",
        k + 1, 70e9 * stiffer, delta_cross_mass);
    joints += fmt::format("  motor_{0}: {{type: hinge, nodes: [ground, hub_{0}], axis: {1}}}\n", k + 1, place(0, 1, 0));
    drives += fmt::format("  motor_{0}: {{joint: motor_{0}, angle: \"0.5*step(t, 0.05, 0.3)\"}}\n", k + 1);
    for (const double side : {-delta_gap, delta_gap}) {
      const std::string rod = fmt::format("{}{}", k + 1, side < 0 ? "l" : "r");
      nodes += fmt::format("  rod_{}: {{position: {}, axes: {{x: {}, y: {}}}}}\n", rod,
                           place(end - reach / 2, side, -depth / 2), place(-reach, 0, -depth), place(0, 1, 0));
      elements +=
          fmt::format("  rod_{}: {{type: rigid_body, node: rod_{}, mass: {}, inertia: [2e-6, 2.45e-3, 2.45e-3]}}\n",
                      rod, rod, delta_rod_mass);
      joints += fmt::format(
          "  elbow_{0}: {{type: spherical, nodes: [elbow_{1}, rod_{0}], position: {2}}}\n"
          "  wrist_{0}: {{type: spherical, nodes: [platform, rod_{0}], position: {3}}}\n",
          rod, k + 1, place(end, side, 0), place(delta_platform, side, -depth));
    }
  }
  return fmt::format(
      "gravity: [0, 0, -9.81]\nnodes:\n  platform: {{position: [0, 0, {:.17g}]}}\n{}elements:\n"
      "  platform: {{type: rigid_body, node: platform, mass: {}, inertia: [4e-4, 4e-4, 8e-4]}}\n{}"
      "joints:\n{}drives:\n{}",
      -depth, nodes, delta_platform_mass, elements, joints, drives);
}

}  // namespace bielle::test
