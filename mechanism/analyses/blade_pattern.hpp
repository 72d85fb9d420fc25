// Pattern of the motions of equal blades around an axis.
//
// The amplitudes q_b of N blades at the azimuths psi_b have the shares, in N sum |q_b|^2,
//     |sum q_b|^2   collective,   |sum q_b exp(i psi_b)|^2   forward,   |sum q_b exp(-i psi_b)|^2   backward,
// since a pattern cos(w t - psi) that runs forwards has q_b = exp(-i psi_b) with the factor exp(i w t).
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/analyses/mode_groups.hpp"

namespace bielle::mechanism {

struct Blade {
  Vector3 radial;          ///< unit vector from the axis to its middle, inertial
  std::vector<int> nodes;  ///< in the same order for each blade
};

/// Returns the blades of a turning group: entries at the same azimuth (pieces of a blade) are one.
/// @param axis  unit vector of the rotation, inertial
/// @returns nothing if it has no two of them with as many nodes, or an entry lies on the axis
std::vector<Blade> blades_around(const Vector3& axis, const ModeGroup& group, const State& state);

struct BladeAmplitude {
  Vector3 radial;                  ///< unit vector from the axis to the blade, inertial
  std::complex<double> amplitude;  ///< displacement along the axis, or along axis x radial [m]
};

/// Returns "collective", "forward", "backward", or "reactionless" ("differential" for two blades); empty if the motion
/// is mixed.
/// @param axis          unit vector of the rotation, inertial
/// @param out_of_plane  whether amplitudes are along the axis
/// @param has_sense     whether forward and backward are those that an observer at rest sees; otherwise "asymmetric"
/// @param standing      for a rotor at rest: columns along the axis, to the side, up. The pattern is then the motion of
/// the hub: "tilt", "yaw", "horizontal", "vertical"
std::string blade_pattern(const std::vector<BladeAmplitude>& blades, const Vector3& axis, bool out_of_plane,
                          bool has_sense, const std::optional<Matrix3>& standing);

}  // namespace bielle::mechanism
