// What a session answers when it is asked for modes.
#pragma once

#include <optional>
#include <string>

#include "mechanism/solvers/linearised/mode_parts.hpp"
#include "mechanism/solvers/linearised/modes.hpp"
#include "mechanism/solvers/linearised/steadiness.hpp"
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
};

struct ModesReport {
  StandingState about;
  Modes found;  ///< shapes of unit size (unit_factor)
  ModeAxes axes = ModeAxes::inertial;
  std::optional<Steadiness> steadiness;  ///< nothing at rest
  double unbalance = 0;                  ///< at rest: the largest missing force relative to the largest that acts
  std::string unbalanced;                ///< its equation, with the force: "force y at node 'pin'"
  MemberEnergies energies;
};

}  // namespace bielle::mechanism
