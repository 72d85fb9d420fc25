// Directions of nodes that no mass resists, though each of their unknowns has some.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

/// How a free node moves without moving mass: a body on a line turns about it, in whatever axes that is written.
/// @param mass  entries of the mass matrix: tangent by the weights {0, 0, 1, 0, 0}
/// @returns in the node's unknowns (dx inertial, rotation in its axes); nothing where all resist, or one has no mass
std::optional<Vector6> massless_direction(const System& system, const std::vector<double>& mass, int node);

/// "rotation of node 'arm' about (0.6, 0.8, 0) in its axes"
std::string massless_name(const System& system, int node, const Vector6& direction);

/// Refuses motions of nodes with neither mass nor resistance that only a combination of rows reveals.
/// @throws ComputationError naming one
void check_massless_directions(const System& system, const State& state);

}  // namespace bielle::mechanism
