// Efforts that are sought where positions and velocities are known: rigid parts.
#pragma once

#include "mechanism/solvers/constraints/mass_saddle.hpp"
#include "mechanism/solvers/constraints/sought_efforts.hpp"

namespace bielle::mechanism {

/// Finds the efforts with which the supports of the moved nodes give nothing, with the accelerations and multipliers
/// that go with them. Nothing where no efforts are sought.
/// @param state  with consistent accelerations @param saddle  factors that serve are used
/// @throws ComputationError where the efforts do not move the nodes independently, or depend on each other through
///         friction in a way that does not settle
void find_sought_efforts(const SoughtEfforts& efforts, const Environment& environment, State& state,
                         MassSaddle& saddle);

}  // namespace bielle::mechanism
