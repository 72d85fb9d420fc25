// Outlines of cross sections, for drawings of beams.
#pragma once

#include <string>

#include "mechanism/drawing/drawn_item.hpp"
#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// Returns the outlines of a shape [m], anticlockwise seen against the beam's direction (y to the right, z upwards).
/// @param offset  offset of its centroid from the node line [m]
DrawnSection section_outline(const std::string& shape, const VectorX& dimensions, const Vector2& offset);

}  // namespace bielle::mechanism
