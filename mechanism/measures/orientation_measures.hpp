// Measures of a node's orientation R, node axes -> inertial axes, by three of its parametrisations.
//
//   rotation_vector.x   component of the rotation vector of R, of up to half a turn [rad]
//   bryant.a, .b, .c    R = Rx(a) Ry(b) Rz(c), b in [-pi/2, pi/2] [rad]
//   euler.a, .b, .c     R = Rz(a) Rx(b) Rz(c), b in [0, pi] [rad]
//   bryant.a.rate, ..   their rates [rad/s]
//
// A function of the state cannot count turns: its values are principal ones, and jump at the limits of their domain. At
// the singularity of the middle angle, first and last angle have no derivatives and no rates: a computation that needs
// them ends the run with an error.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanism/model/measure.hpp"

namespace bielle::mechanism {

/// Names of the measures that every node has: "bryant.a", "bryant.a.rate", ...
const std::vector<std::string>& orientation_measure_names();
/// Creates one of these measures of a node.
std::unique_ptr<Measure> make_orientation_measure(const std::string& name, int node, const std::string& measure);

}  // namespace bielle::mechanism
