// Small motions about the present state of a session as a state-space model.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/analyses/frequency_response.hpp"

namespace bielle::mechanism {

struct StateSpaceOptions {
  std::vector<ResponseInput> inputs;
  std::vector<ResponseOutput> outputs;
  std::optional<SteadyRotation> rotation = {};
};

/// E x' = A x + B u, y = C x + D u: u and y are deviations of inputs and outputs from their values in the state. E is
/// regular. The number of states is the number of finite eigenvalues: constraints, massless directions and algebraic
/// unknowns are eliminated.
struct StateSpace : LinearisedSetting {
  MatrixX E, A, B, C, D;
  /// (unknowns, states): increments of dofs and first-order unknowns, in their units, per unit of each state
  MatrixX unknowns;
  std::vector<std::string> output_units;
};

/// Computes the state-space model with constraints eliminated; the present state of the session is not changed.
/// @throws InputError for names that the model does not have; ComputationError if an output depends on the derivative
/// of an input, or the mechanism cannot move
StateSpace compute_state_space(Session& session, const StateSpaceOptions& options);

}  // namespace bielle::mechanism
