// Number of growing motions, counted without a search: by the inertia of D(s) at a real s, with one factorisation.
//
// If the equations are symmetric, every real eigenvalue above s moves one direction of D from negative to positive as s
// grows to infinity, where D is dominated by inertia. Without forces that supply energy (C >= 0), every growing motion
// has a real eigenvalue.
#pragma once

#include <optional>

#include "mechanism/solvers/linearised/equations.hpp"

namespace bielle::mechanism {

/// @returns the number of motions that grow faster than exp(s t), s > 0, or no value if the equations are not symmetric
std::optional<int> count_growing(const LinearisedEquations& equations, double s);

/// In axes that rotate with a steady rotation: number of motions for which centrifugal forces exceed the stiffness, by
/// more than a millionth. Above a critical speed there are such motions, and unbalance deflects a rotor to the other
/// side.
/// @param rate  rate of the rotation [rad/s]; @returns no value if D(0) is not symmetric
std::optional<int> count_outweighed(const LinearisedEquations& equations, double rate);

}  // namespace bielle::mechanism
