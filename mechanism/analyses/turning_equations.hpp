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
  PeriodicEquations periodic;
  std::vector<char> turning;  ///< for each unknown, whether it belongs to the part
  std::string joint;          ///< its description
};

}  // namespace bielle::mechanism
