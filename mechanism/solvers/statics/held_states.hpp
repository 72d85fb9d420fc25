// First-order unknowns in statics: each has the value at which its rate is zero, if that determines it.
//
// An integral that nothing depends on, or a clock, has no such value: it is kept, out of the equations (State::held).
// The unknowns to hold are determined at the beginning of an analysis, under the whole load, by the response of the
// rates f of the unknowns y to changes of y while all other unknowns follow in equilibrium:
//     S = df/dy - df/dq (dr/dq)^-1 dr/dy,      r: forces and constraints.
// An unknown whose row or column of S is zero is held; this is repeated for the rest. The controller of a closed loop
// is not held: its integral changes the position, which changes the integral's rate.
#pragma once

#include <string>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Begins a static analysis: sets `held` of a state at rest, and moves the other first-order unknowns to the initial
/// guess of their components (Component::add_start_values).
/// @param environment  environment of statics, under the whole load
void begin_states(const System& system, const Environment& environment, State& state);

/// Returns the names of the held unknowns: "value of state 'way'".
std::vector<std::string> held_names(const System& system, const State& state);
/// Returns a sentence about them.
std::string describe_held(const std::vector<std::string>& names);

}  // namespace bielle::mechanism
