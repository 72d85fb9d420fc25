// Axes in which small motions about a state are described, and possible errors of the state.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mechanism/solvers/linearised/equations.hpp"
#include "mechanism/solvers/linearised/harmonic_modes.hpp"
#include "mechanism/solvers/linearised/steadiness.hpp"
#include "mechanism/solvers/linearised/steady_rotation.hpp"

namespace bielle::mechanism {

struct LinearisedSetting {
  ModeAxes axes = ModeAxes::inertial;
  std::optional<Steadiness> steadiness;  ///< empty at rest
  /// In steady rotation as a whole: the largest force that keeps its direction, "49 N at node 'disc'"; empty: none.
  std::string standing;
  double unbalance = 0;    ///< at rest: largest residual force relative to the largest acting force
  std::string unbalanced;  ///< equation of this residual force: "force y at node 'pin'"
  /// In steady rotation behind a joint: dependence of the equations on the azimuth; the fields above are not set.
  struct Turning {
    std::string joint;  ///< its description: "joint 'shaft'"
    double rate = 0;    ///< [rad/s]
    Periodicity periodicity = Periodicity::constant;
    int harmonics = 0;
    double change = 0;  ///< relative change of the exponents by further harmonics, or smaller steps
    bool mean = false;  ///< whether motions are about the mean state, without alternating forces
    /// Vibration by gravity across the axis and unbalance: largest displacement [m] and its node, largest rotation
    /// [rad], harmonics of the rotation; 0 without one.
    double displacement = 0, rotation = 0;
    std::string moved = {};
    int orbit_harmonics = 0;
    /// Number of harmonics that did not suffice to resolve the motions about this vibration
    /// (HarmonicModes::unresolved).
    int unresolved = 0;
    /// In a sweep: the rates [rad/s] at which they were not resolved, and modes are those about the mean state.
    std::set<double> unresolved_at = {};
  };
  std::optional<Turning> turning;
  /// Delays that are neglected, i.e. taken as zero (describe_delays).
  std::vector<std::string> delays;
};

/// @param rotation  steady rotation into which the whole mechanism was brought
LinearisedSetting linearised_setting(const System& system, const Environment& environment, const State& state,
                                     const std::optional<SteadyRotation>& rotation);

}  // namespace bielle::mechanism
