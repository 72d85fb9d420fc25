// First-order unknowns in statics: each has the value at which its rate is zero, where that determines it.
//
// An integral that nothing depends on, or a clock, has no such value: it stays where it is, out of the equations
// (State::held). Which these are is judged where an analysis begins, under the whole load, by what the rates f of the
// unknowns y answer to changes of y while everything else follows in equilibrium:
//     S = df/dy - df/dq (dr/dq)^-1 dr/dy,      r the forces and constraints.
// An unknown whose row or column of S is zero is held, and those that are then left without either. The controller of a
// closed loop is none of them: its integral changes the position, which changes the integral's rate.
#pragma once

#include <string>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Begins a static analysis: sets `held` of a state at rest, and moves the other first-order unknowns to where their
/// components say that the search begins (Component::add_start_values).
/// @param environment  of statics, under the whole load
void begin_states(const System& system, const Environment& environment, State& state);

/// Names of the unknowns that are held: "value of state 'way'".
std::vector<std::string> held_names(const System& system, const State& state);
/// A sentence about them.
std::string describe_held(const std::vector<std::string>& names);

}  // namespace bielle::mechanism
