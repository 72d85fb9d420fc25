// The smallest gap of a shape and a surface of triangles, and whether they go through each other.
#pragma once

#include "mechanism/contacts/on_surface.hpp"

namespace bielle::mechanism {

/// What is within a closed surface is deeper than its skin; behind an open one nothing is within. Where an edge of the
/// shape pierces the surface, or a ridge of the surface the shape's core, the depth is beyond the skin, too.
/// @param pair  of which one is a surface
Touch<double> nearest_on_surface(const PairOfShapes<double>& pair);

}  // namespace bielle::mechanism
