// What a session answers when it is asked for modes.
#pragma once

#include <memory>
#include <optional>

#include "mechanism/session/linearised_setting.hpp"
#include "mechanism/solvers/linearised/mode_parts.hpp"
#include "mechanism/solvers/linearised/modes.hpp"
#include "mechanism/solvers/linearised/steady_rotation.hpp"
#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// The state that the modes are about, as a motion would begin with it, and what acts there.
struct StandingState {
  State state;
  Environment environment;
  StartReport start;  ///< what had to be made consistent
};

struct ModesOptions {
  ModeOptions search;
  std::optional<SteadyRotation> rotation = {};  ///< modes about the steady rotation that begins at the state
  std::optional<ModeAxes> axes = {};            ///< in which to see them; nothing: those that suit the motion
  bool energies = true;                         ///< whether they are computed
};

struct ModesReport : LinearisedSetting {
  StandingState about;
  Modes found;  ///< shapes of unit size (unit_factor)
  MemberEnergies energies;
  std::shared_ptr<const LinearisedEquations> equations;  ///< whose modes they are
  /// In steady rotation: motions along which centrifugal forces outweigh what holds them (count_outweighed).
  std::optional<int> outweighed;
};

}  // namespace bielle::mechanism
