// How many motions grow, counted and not searched for: by the inertia of D(s) at a real s, one factorisation.
//
// If the equations are symmetric, every real eigenvalue above s takes one direction of D from negative to positive as s
// grows without bound, where D is inertia. Without forces that feed motions (C >= 0) all that grows has a real
// eigenvalue.
#pragma once

#include <optional>

#include "mechanism/solvers/linearised/equations.hpp"

namespace bielle::mechanism {

/// @returns how many motions grow faster than exp(s t), s > 0, or nothing where the equations are not symmetric
std::optional<int> count_growing(const LinearisedEquations& equations, double s);

/// In axes that turn with a steady rotation: along how many motions centrifugal forces outweigh what holds them, by
/// more than a millionth. Above a critical speed there are some, and unbalance deflects a rotor to the other side.
/// @param rate  of the rotation [rad/s]; @returns nothing where D(0) is not symmetric
std::optional<int> count_outweighed(const LinearisedEquations& equations, double rate);

}  // namespace bielle::mechanism
