// The linearised equations about a steady rotation behind a joint, in the form for analyses of small motions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/analyses/linearised_setting.hpp"
#include "mechanism/analyses/standing_state.hpp"
#include "mechanism/solvers/linearised/azimuth_equations.hpp"
#include "mechanism/solvers/linearised/harmonic_modes.hpp"
#include "mechanism/solvers/linearised/periodic_orbit.hpp"
#include "mechanism/solvers/linearised/turning_part.hpp"

namespace bielle::mechanism {

struct TurningEquations {
  /// @param about  state in this rotation @throws ComputationError if the rotation is not steady
  TurningEquations(const System& system, const StandingState& about, const SteadyRotation& rotation);

  /// Returns the mechanism at equidistant azimuths of a turn, along the periodic motion if there is one.
  std::vector<Azimuth> azimuths(const System& system, const StandingState& about, int count) const;
  HarmonicSearch search() const {
    return {periodic, turning, orbit ? orbit->shift : MatrixX(), mean_periodic ? &*mean_periodic : nullptr};
  }
  LinearisedSetting setting(const HarmonicModes& modes) const;

  TurningPart part;
  /// Whether the rate is negligible compared with all frequencies: modes are those of the mechanism at rest, with the
  /// part at its present azimuth.
  bool negligible;
  /// Vibrations about the mean state by gravity across the axis and unbalance; empty if there are none, or if the
  /// equations are requested about the mean state.
  std::optional<PeriodicOrbit> orbit;
  PeriodicEquations periodic;  ///< equations of the harmonics; at a negligible rate those of the present azimuth alone
  /// The equations about the mean state, if there is a periodic motion.
  std::optional<PeriodicEquations> mean_periodic;
  std::vector<char> turning;  ///< for each unknown, whether it belongs to the part
  std::string joint;          ///< its description
  std::string moved;          ///< name of the node that the orbit moves farthest
  bool mean;                  ///< whether vibrations are left out on request
};

}  // namespace bielle::mechanism
