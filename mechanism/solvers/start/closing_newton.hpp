// Newton's method for the closing of loops, damped: see assemble_positions.hpp.
#pragma once

#include "mechanism/solvers/start/closing_equations.hpp"

namespace bielle::mechanism {

/// Whether a state is closed to rounding as it is.
bool is_closed(const ClosingEquations::Gaps& gaps);

/// Closes gaps from a state. @returns whether they are closed; otherwise the state is where they shrink no further
bool close_gaps(ClosingEquations& equations, State& state);

/// Brings what gaps there are together in one member or condition, the others held.
/// @param soft  rows that may open
/// @returns the forces with which the rows pull on each other (rows): what disagrees has some
VectorX gather_gaps(ClosingEquations& equations, const std::vector<bool>& soft, State& state);

}  // namespace bielle::mechanism
