// Sizes of positions and constraints, for tolerances that do not depend on units.
#pragma once

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Largest distance of a node from the inertial origin [m], which is what positions are rounded by; 1 where all nodes
/// stand there.
double model_length(const State& state);

/// Diagonal of the box around all nodes but the ground, which stands at the origin wherever the mechanism is [m]; 0
/// where they stand in one point, to rounding.
double spread(const State& state);

/// The same, or `model_length` of nodes in one point: never zero.
double model_extent(const State& state);

/// The scale that each constraint's residual is compared with: sum_j |B_ij| s_j, s_j the model's length for
/// translations and 1 rad for rotations; lengths of arms count through B. 1 for rows without entries. @returns
/// (multipliers)
VectorX constraint_sizes(const System& system, const Environment& environment, const State& state);

/// The same of one constraint of a member alone, also when it is set aside.
/// @param row     among the member's own constraints
/// @param length  the model's length [m]
double constraint_size(const System& system, const Environment& environment, const State& state, std::size_t member,
                       int row, double length);

}  // namespace bielle::mechanism
