#include "mechanism/language/placement.hpp"

namespace bielle::mechanism {

using Geometry = KeyForm::Geometry;

bool Placement::moves() const { return !frame.x.isZero(0) || !frame.R.isIdentity(0); }
bool Placement::is_identity() const { return mirrored < 0 && !moves(); }

Matrix3 Placement::reflection() const {
  Matrix3 M = Matrix3::Identity();
  if (mirrored >= 0) M(mirrored, mirrored) = -1;
  return M;
}

Matrix3 Placement::matrix(Geometry geometry, bool inertial) const {
  Matrix3 A = reflection();
  if (geometry == Geometry::axial && mirrored >= 0) A = -A;
  return inertial ? Matrix3(frame.R * A) : A;
}

Matrix3 Placement::orientation(const Matrix3& R, bool inertial) const {
  const Matrix3 M = reflection();
  const Matrix3 mirrored_axes = M * R * M;
  return inertial ? Matrix3(frame.R * mirrored_axes) : mirrored_axes;
}

// x = x_1 + R_1 M_1 (x_2 + R_2 M_2 p) = x_1 + R_1 M_1 x_2 + R_1 (M_1 R_2 M_1) M_1 M_2 p. Two reflections are a
// rotation, which goes into the frame.
Placement Placement::inner(const Placement& part) const {
  Placement result;
  const Matrix3 M_1 = reflection();
  result.frame.x = frame.x + frame.R * (M_1 * part.frame.x);
  result.frame.R = frame.R * M_1 * part.frame.R * M_1;
  if (mirrored >= 0 && part.mirrored >= 0) {
    result.frame.R = result.frame.R * M_1 * part.reflection();
  } else {
    result.mirrored = mirrored >= 0 ? mirrored : part.mirrored;
  }
  return result;
}

}  // namespace bielle::mechanism
