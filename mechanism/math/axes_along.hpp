// Right-handed axes with one given direction.
#pragma once

#include <Eigen/Geometry>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// Columns x, y, z: z as given, x normal to it in the plane of z and the inertial axis that is most normal to z.
/// @param z  unit vector
inline Matrix3 axes_along(const Vector3& z) {
  Eigen::Index least = 0;
  z.cwiseAbs().minCoeff(&least);
  const Vector3 x = (Vector3::Unit(least) - z * z[least]).normalized();
  Matrix3 axes;
  axes << x, z.cross(x), z;
  return axes;
}

}  // namespace bielle::mechanism
