// Directions of nodes without mass, although each of their unknowns has some mass.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// Finds the motion of a free node that moves no mass, in any axes: an example is the rotation of a line-shaped body
/// about its line.
/// @param mass  entries of the mass matrix: tangent with the weights {0, 0, 1, 0, 0}
/// @returns in the node's unknowns (dx inertial, rotation in its axes); no value if all directions have mass, or one
/// unknown has none
std::optional<Vector6> massless_direction(const System& system, const std::vector<double>& mass, int node);

/// Returns "rotation of node 'arm' about (0.6, 0.8, 0) in its axes".
std::string massless_name(const System& system, int node, const Vector6& direction);

/// Rejects motions of nodes with neither mass nor stiffness, damping or constraint that only show in a combination of
/// rows.
/// @throws ComputationError naming one
void check_massless_directions(const System& system, const State& state);

}  // namespace bielle::mechanism
