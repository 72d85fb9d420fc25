// The reference state of small motions.
#pragma once

#include <optional>

#include "mechanism/session/session.hpp"
#include "mechanism/solvers/linearised/steady_rotation.hpp"

namespace bielle::mechanism {

/// The state with which a motion would begin, and its environment.
struct StandingState {
  State state;
  Environment environment;
  StartReport start;  ///< changes made by the consistent start
};

/// Returns the present state of a session, which is not changed: a start made consistent, an equilibrium under its
/// fraction of the load, or the end of a motion. Delayed values are the present ones.
/// @param rotation  steady rotation into which the state is brought; step recorders then receive it. @throws
///                  ComputationError
StandingState standing_state(Session& session, const std::optional<SteadyRotation>& rotation);

}  // namespace bielle::mechanism
