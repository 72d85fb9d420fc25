// Description of parts that cannot be brought together: which one stays open, by how much, and which members it
// contradicts.
#pragma once

#include <string>

#include "mechanism/solvers/start/closing_equations.hpp"

namespace bielle::mechanism {

struct Unclosed {
  bool closes = false;  ///< the gaps can be closed after all: the state is then close to a solution
  std::string text;  ///< "joint 'd' stays open by 0.5 m whatever the other parts do; it disagrees with joint 'a', .."
};

/// Satisfies all contradictory members except the last start value, drive or joint, moves the state to the smallest gap
/// of that one, and describes it. @param state  state at which the gaps do not decrease any more
Unclosed explain_unclosed(ClosingEquations& equations, State& state);

}  // namespace bielle::mechanism
