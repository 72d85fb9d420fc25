// Small motions as a state space: what a session is asked, and what it answers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/session/frequency_response.hpp"

namespace bielle::mechanism {

struct StateSpaceOptions {
  std::vector<ResponseInput> inputs;
  std::vector<ResponseOutput> outputs;
  std::optional<SteadyRotation> rotation = {};
};

/// E x' = A x + B u, y = C x + D u: u and y are deviations of inputs and outputs from their values in the state. E is
/// regular. There are as many states as finite eigenvalues: constraints, massless directions and algebraic unknowns are
/// eliminated.
struct StateSpace : LinearisedSetting {
  MatrixX E, A, B, C, D;
  /// (unknowns, states): increments of dofs and first-order unknowns, in their units, of a unit of each state
  MatrixX unknowns;
  std::vector<std::string> output_units;
};

}  // namespace bielle::mechanism
