// The motion of a point of a superelement's mesh in terms of the body's coordinates.
#pragma once

#include "mechanism/math/types.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::mechanism {

/// Displacement and rotation (6,n), body axes, at a point, by the mesh nodes around it
/// (reduce/superelement/point_weights.hpp).
/// @param point  body axes
/// @throws InputError when the body keeps no displacements, or the point is away from the mesh
MatrixX point_shapes(const Superelement& body, const Vector3& point);

}  // namespace bielle::mechanism
