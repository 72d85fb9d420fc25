// A rig that pulls a wheel over a plane: its height, its heading and, if wanted, its spin are prescribed.
#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

namespace bielle::test {

/// The tyre has radius 0.5 m and stiffness 1e5 N/m, and is pressed in by 0.02 m if it is upright.
struct TyreRig {
  double speed = 10;  ///< speed of the hub along x [m/s]
  double angle = 0;   ///< heading of the wheel from x about z [rad]
  double camber = 0;  ///< angle of the axis with the road, positive if it points up [rad]
  double spin = 0;    ///< prescribed spin about the axis [rad/s]; 0: the wheel turns freely
  std::string tyre;   ///< keys of the tyre after its stiffness
  static constexpr double radius = 0.5, height = 0.48, stiffness = 1e5;
  static constexpr double rolling_radius = (2 * radius + height) / 3;

  double load() const { return stiffness * (radius * std::cos(camber) - height); }

  std::string text() const {
    const double x = -std::sin(angle) * std::cos(camber), y = std::cos(angle) * std::cos(camber), z = std::sin(camber);
    const double rolling = (2 * radius + height / std::cos(camber)) / 3;
    const double w = spin != 0 ? spin : speed * std::cos(angle) / rolling;
    return fmt::format(R"yaml(
nodes:
  fork: {{position: [0, 0, 0.48], velocity: [{0:.17g}, 0, 0]}}
  hub: {{position: [0, 0, 0.48], velocity: [{0:.17g}, 0, 0], angular_velocity: [{4:.17g}, {5:.17g}, {6:.17g}]}}
elements:
  disk: {{type: rigid_body, node: hub, mass: 10, inertia: [1, 1, 1]}}
  frame: {{type: rigid_body, node: fork, mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints:
  tow: {{type: prismatic, nodes: [ground, fork], axis: [1, 0, 0]}}
  axle: {{type: hinge, nodes: [fork, hub], axis: [{1:.17g}, {2:.17g}, {3:.17g}]}}
  tyre: {{type: tyre, nodes: [ground, hub], normal: [0, 0, 1], position: [0, 0, 0],
          axis: [{1:.17g}, {2:.17g}, {3:.17g}],
          radius: 0.5, stiffness: 1e5, {7}}}
drives:
  pull: {{joint: tow, speed: {0:.17g}}}
{8})yaml",
                       speed, x, y, z, w * x, w * y, w * z, tyre,
                       spin != 0 ? fmt::format("  turn: {{joint: axle, rate: {:.17g}}}\n", spin) : "");
  }
};

}  // namespace bielle::test
