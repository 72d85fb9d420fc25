// Computes the smallest gap of a shape and a surface of triangles, and detects whether they penetrate each other.
#pragma once

#include "mechanism/contacts/on_surface.hpp"

namespace bielle::mechanism {

/// A point within a closed surface is deeper than its skin; an open surface has no interior. The depth also exceeds the
/// skin if an edge of the shape pierces the surface, or a ridge of the surface pierces the core of the shape.
/// @param pair  a pair in which one shape is a surface
Touch<double> nearest_on_surface(const PairOfShapes<double>& pair);

}  // namespace bielle::mechanism
