// Sizes of positions and constraints, for tolerances that do not depend on units.
#pragma once

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Returns the largest distance of a node from the inertial origin [m], to which rounding of positions is relative; 1
/// if all nodes are at the origin.
double model_length(const State& state);

/// Returns the diagonal of the box around all nodes except the ground, which is at the origin independently of the
/// mechanism [m]; 0 if they are at one point, up to rounding.
double spread(const State& state);

/// Returns the same, or `model_length` if all nodes are at one point: never zero.
double model_extent(const State& state);

/// Returns the scale of each constraint's residual: sum_j |B_ij| s_j, where s_j is the model's length for translations
/// and 1 rad for rotations; lengths of lever arms are included through B. It is 1 for rows without entries. @returns
/// (multipliers)
VectorX constraint_sizes(const System& system, const Environment& environment, const State& state);

/// Returns the scale of one constraint of a member, also if it is set aside.
/// @param row     index among the member's own constraints
/// @param length  the model's length [m]
double constraint_size(const System& system, const Environment& environment, const State& state, std::size_t member,
                       int row, double length);

}  // namespace bielle::mechanism
