// Right-handed axes with one given direction.
#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// Returns the axis x, y or z that is most normal to a vector: the first one of several that are equally so, up to
/// rounding. @param v  not zero
inline Vector3 most_normal_axis(const Vector3& v) {
  const double rounding = 1e-9 * v.norm();
  Eigen::Index least = 0;
  for (const Eigen::Index k : {1, 2})
    if (std::abs(v[k]) < std::abs(v[least]) - rounding) least = k;
  return Vector3::Unit(least);
}

/// Columns x, y, z: z as given, x normal to it in the plane of z and the inertial axis that is most normal to z.
/// @param z  unit vector
inline Matrix3 axes_along(const Vector3& z) {
  const Vector3 least = most_normal_axis(z);
  const Vector3 x = (least - z * z.dot(least)).normalized();
  Matrix3 axes;
  axes << x, z.cross(x), z;
  return axes;
}

}  // namespace bielle::mechanism
