// The state that small motions are about.
#pragma once

#include <optional>

#include "mechanism/session/session.hpp"
#include "mechanism/solvers/linearised/steady_rotation.hpp"

namespace bielle::mechanism {

/// The state as a motion would begin with it, and the environment there.
struct StandingState {
  State state;
  Environment environment;
  StartReport start;  ///< what had to be made consistent
};

/// The present state of a session, which stays: a start made consistent, an equilibrium under the part of the load that
/// it stands under, the end of a motion.
/// @param rotation  into which it is brought from there; components gather there. @throws ComputationError
StandingState standing_state(Session& session, const std::optional<SteadyRotation>& rotation);

}  // namespace bielle::mechanism
