// Modes of small motions about the present state of a session.
#pragma once

#include <memory>
#include <optional>

#include "mechanism/analyses/linearised_setting.hpp"
#include "mechanism/analyses/standing_state.hpp"
#include "mechanism/solvers/linearised/mode_parts.hpp"
#include "mechanism/solvers/linearised/modes.hpp"

namespace bielle::mechanism {

struct ModesOptions {
  ModeOptions search;
  std::optional<SteadyRotation> rotation = {};  ///< modes about the steady rotation that begins at the state
  std::optional<ModeAxes> axes = {};            ///< axes of the modes; empty: those that suit the motion
  bool energies = true;                         ///< whether energies are computed
};

struct ModesReport : LinearisedSetting {
  StandingState about;
  Modes found;  ///< shapes have unit size (unit_factor)
  MemberEnergies energies;
  std::shared_ptr<const LinearisedEquations> equations;  ///< the linearised equations of the modes
  /// In steady rotation: number of motions for which centrifugal forces exceed the stiffness (count_outweighed).
  std::optional<int> outweighed;
};

/// The state of the session is kept. @throws ComputationError
ModesReport compute_modes(Session& session, const ModesOptions& options);

}  // namespace bielle::mechanism
