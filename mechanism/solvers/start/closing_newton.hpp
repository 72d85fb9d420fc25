// Damped Newton's method for the closing of loops: see assemble_positions.hpp.
#pragma once

#include "mechanism/solvers/start/closing_equations.hpp"

namespace bielle::mechanism {

/// Returns whether a state is closed to rounding.
bool is_closed(const ClosingEquations::Gaps& gaps);

/// Closes the gaps from a state. @returns whether they are closed; otherwise the state is the one at which they do not
/// decrease any more
bool close_gaps(ClosingEquations& equations, State& state);

/// Moves the existing gaps to one member or condition, with the others satisfied.
/// @param soft  rows that may open
/// @returns the forces between the rows (rows): contradictory rows have nonzero ones
VectorX gather_gaps(ClosingEquations& equations, const std::vector<bool>& soft, State& state);

}  // namespace bielle::mechanism
