// Surfaces by shape: which triangles lie on a cylinder, on a plane or in a box.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "reduce/mesh/body_surface.hpp"
#include "reduce/mesh/mesh_request.hpp"

namespace bielle::reduce {

/// How far a node may lie from the shape that selects it: 1e-4 of the diagonal of the body's box [m]. Wide enough for
/// coordinates with six digits, narrow enough to distinguish neighbouring surfaces.
double selection_tolerance(const Eigen::Matrix3Xd& points);

/// Whether a triangle lies on (in) each of the shapes: its three corners do (mid-side nodes may be straight) and, on a
/// cylinder or a plane, its normal is within 60 degrees of the shape's. The normal keeps a coarse disc, all of whose
/// nodes lie on its rim, off the cylinder.
bool lies_on(const ShapeSelector& shape, const Eigen::Matrix3Xd& points, const Triangle& triangle, double tolerance);

/// "on the cylinder with radius 0.011 m about (..) along (..) and in the box from (..) to (..)"
std::string selector_name(const ShapeSelector& shape);

/// Numbers of the triangles that a shape selects, ascending. On a geometry a shape takes whole surfaces: those all of
/// whose triangles lie on it. On a mesh it takes triangles.
/// @throws InputError when there are none: which cylinders, planes or surfaces come nearest
std::vector<int> select_triangles(const ShapeSelector& shape, const Eigen::Matrix3Xd& points,
                                  const BodySurface& surface);

}  // namespace bielle::reduce
