// Describes friction that is too small for an equilibrium (model/sticking_part.hpp).
#pragma once

#include <string>

#include "mechanism/solvers/statics/equilibrium.hpp"

namespace bielle::mechanism {

/// Computes the equilibrium in which all parts with friction stick, at the full load or else at a load factor at which
/// there is no other one.
/// @param state  last equilibrium, from which it is searched for
/// @returns clauses on the overloaded parts, each after a semicolon; empty if there are none, or no such equilibrium
std::string describe_overloaded_friction(const LoadRamp& ramp, Equilibrium& equilibrium, double factor,
                                         const State& state);

}  // namespace bielle::mechanism
