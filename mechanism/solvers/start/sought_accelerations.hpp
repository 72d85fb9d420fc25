// Sought efforts for known positions and velocities of mechanisms of rigid parts.
#pragma once

#include "mechanism/solvers/constraints/kkt_matrix.hpp"
#include "mechanism/solvers/constraints/sought_efforts.hpp"

namespace bielle::mechanism {

/// Finds the efforts for which the supports of the moved nodes have no reaction, with the corresponding accelerations
/// and multipliers. The function does nothing if no efforts are sought.
/// @param state  state with consistent accelerations @param saddle  valid factors are used
/// @throws ComputationError if the efforts do not move the nodes independently, or if their dependence on each other
///         through friction does not converge
void find_sought_efforts(const SoughtEfforts& efforts, const Environment& environment, State& state, KktMatrix& saddle);

}  // namespace bielle::mechanism
