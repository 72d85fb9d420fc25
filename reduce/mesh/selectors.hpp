// Selection of surfaces by shape: the faces on a cylinder, on a plane or in a box.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "reduce/mesh/body_surface.hpp"
#include "reduce/mesh/mesh_request.hpp"

namespace bielle::reduce {

/// Largest distance of a node from the shape that selects it: 1e-4 of the diagonal of the body's box [m]. The value is
/// large enough for coordinates with six digits and small enough to distinguish neighbouring surfaces.
double selection_tolerance(const Eigen::Matrix3Xd& points);

/// Tells whether a face lies on (in) each of the shapes: its corners do (mid-side nodes may be straight) and,
/// on a cylinder or a plane, its normal is within 60 degrees of the shape's. The condition on the normal excludes a
/// coarse disc, whose nodes all lie on its rim, from the cylinder.
bool lies_on(const ShapeSelector& shape, const Eigen::Matrix3Xd& points, const Corners& side, double tolerance);

/// "on the cylinder with radius 0.011 m about (..) along (..) and in the box from (..) to (..)"
std::string selector_name(const ShapeSelector& shape);

/// Numbers of the sides that a shape selects, ascending. On a geometry a shape selects whole surfaces: those whose
/// sides all lie on it. On a mesh it selects sides.
/// @throws InputError if there are none; it names the nearest cylinders, planes or surfaces
std::vector<int> select_sides(const ShapeSelector& shape, const Eigen::Matrix3Xd& points, const BodySurface& surface);

}  // namespace bielle::reduce
