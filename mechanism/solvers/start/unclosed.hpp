// What to say of parts that cannot be brought together: what stays open, by how much, and what it disagrees with.
#pragma once

#include <string>

#include "mechanism/solvers/start/closing_equations.hpp"

namespace bielle::mechanism {

struct Unclosed {
  bool closes = false;  ///< after all: the state is then close to where everything fits
  std::string text;  ///< "joint 'd' stays open by 0.5 m whatever the other parts do; it disagrees with joint 'a', .."
};

/// Holds all that disagrees but the last start value, drive or joint, moves the state to where the gap of that one is
/// smallest, and says so. @param state  where the gaps shrink no further
Unclosed explain_unclosed(ClosingEquations& equations, State& state);

}  // namespace bielle::mechanism
