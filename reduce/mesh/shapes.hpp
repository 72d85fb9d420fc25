// Recognition of elementary surfaces. Planes, cylinders, cones, spheres and tori are recognised from points and
// normals.
#pragma once

#include <string>
#include <variant>

#include <Eigen/Core>

namespace bielle::reduce {

struct PlaneShape {
  Eigen::Vector3d point, normal;  ///< the point is the mean of the samples; unit normal
};
struct CylinderShape {
  Eigen::Vector3d point, axis;  ///< point of the axis halfway along the samples; unit axis
  double radius;
};
struct ConeShape {
  Eigen::Vector3d apex, axis;  ///< unit axis from the apex into the sampled nappe
  double half_angle;           ///< [rad]
};
struct SphereShape {
  Eigen::Vector3d centre;
  double radius;
};
struct TorusShape {
  Eigen::Vector3d centre, axis;
  double major_radius, minor_radius;
};

/// std::monostate: no shape was recognised.
using Shape = std::variant<std::monostate, PlaneShape, CylinderShape, ConeShape, SphereShape, TorusShape>;

/// Returns the simplest shape on which all points lie within the tolerance; the plane is tried first, the torus last.
///
/// Initial guesses come from the normals (those of a cylinder are normal to its axis, those of a cone make one angle
/// with it, those of any surface of revolution meet its axis: H. Pottmann, J. Wallner, Computational Line Geometry,
/// Springer 2001, ch. 4); Gauss-Newton iterations on the distances of the points refine them, so that inaccurate
/// normals (of the triangles of a mesh) are sufficient.
/// @param points   (3,n), more than 8 for a curved shape
/// @param normals  (3,n) unit normals there, exact or not, either sense
/// @param tolerance  [m]
Shape recognise_shape(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& normals, double tolerance);

/// "plane", "cylinder", ... "free form"
std::string shape_kind(const Shape& shape);

/// "cylinder with radius 0.011 m about (0.2, 0, 0) m along (0, 0, 1)"
std::string shape_name(const Shape& shape);

}  // namespace bielle::reduce
