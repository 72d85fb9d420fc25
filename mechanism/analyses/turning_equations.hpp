// The linearised equations about a steady rotation behind a joint, as analyses of small motions use them.
#pragma once

#include "mechanism/analyses/linearised_setting.hpp"
#include "mechanism/analyses/standing_state.hpp"
#include "mechanism/solvers/linearised/harmonic_modes.hpp"
#include "mechanism/solvers/linearised/turning_part.hpp"

namespace bielle::mechanism {

struct TurningEquations {
  /// @param about  state in this rotation @throws ComputationError if it is not steady
  TurningEquations(const System& system, const StandingState& about, const SteadyRotation& rotation);

  HarmonicSearch search() const { return {periodic, turning}; }
  LinearisedSetting setting(const HarmonicModes& modes) const;

  TurningPart part;
  /// Whether the rate is negligible compared with all frequencies: modes are those of the mechanism at rest, with the
  /// part at its present azimuth.
  bool negligible;
  PeriodicEquations periodic;  ///< at a negligible rate those of the present azimuth alone
  std::vector<char> turning;   ///< for each unknown, whether it belongs to the part
  std::string joint;           ///< its description
};

}  // namespace bielle::mechanism
