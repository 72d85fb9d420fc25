// The motion of a point of a superelement's mesh as a function of the body's coordinates.
#pragma once

#include "mechanism/math/types.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::mechanism {

/// Returns displacement and rotation (6,n), body axes, at a point, from the mesh nodes around it
/// (reduce/superelement/point_weights.hpp).
/// @param point  in body axes
/// @throws InputError if the body file contains no displacements, or the point is outside of the mesh
MatrixX point_shapes(const Superelement& body, const Vector3& point);

}  // namespace bielle::mechanism
