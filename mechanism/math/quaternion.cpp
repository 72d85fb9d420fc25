// Unit quaternions p = (w, e). With p* the conjugate, Omega = 2 (p* pdot)_e and pdot = p (0, Omega)/2.
#include <cmath>

#include "mechanism/math/rotation_parameters.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

using Quaternion = UnitQuaternion::Parameters;

/// Returns 2 [-e, w I - e~]: linear in p; T of a unit quaternion.
UnitQuaternion::Tangent left_operator(const Quaternion& p) {
  UnitQuaternion::Tangent L;
  const Vector3 e = p.tail<3>();
  L << -2 * e, 2 * (p[0] * Matrix3::Identity() - skew(e));
  return L;
}

double squared_length(const Quaternion& p) {
  const double square = p.squaredNorm();
  if (!(square > 0 && std::isfinite(square)))
    throw ComputationError("a quaternion whose length is zero or not finite stands for no rotation");
  return square;
}

}  // namespace

Matrix3 UnitQuaternion::rotation(const Quaternion& p) { return rotation_of_quaternion(p); }

Quaternion UnitQuaternion::parameters(const Matrix3& R) { return quaternion_of(R); }

Quaternion UnitQuaternion::principal(const Quaternion& p) {
  const double length = std::sqrt(squared_length(p));
  return p / (p[0] < 0 ? -length : length);
}

Quaternion UnitQuaternion::complement(const Quaternion& p) { return -p; }

Quaternion UnitQuaternion::compose(const Quaternion& p, const Quaternion& second) {
  const Vector3 e = p.tail<3>(), f = second.tail<3>();
  Quaternion product;
  product << p[0] * second[0] - e.dot(f), p[0] * f + second[0] * e + e.cross(f);
  return principal(product);
}

UnitQuaternion::Tangent UnitQuaternion::tangent(const Quaternion& p) { return left_operator(p) / squared_length(p); }

UnitQuaternion::Inverse UnitQuaternion::tangent_inverse(const Quaternion& p) {
  return 0.25 * left_operator(p).transpose();
}

UnitQuaternion::Tangent UnitQuaternion::tangent_derivative(const Quaternion& p, const Quaternion& u) {
  const double square = squared_length(p);
  return (left_operator(u) - (2 * p.dot(u) / square) * left_operator(p)) / square;
}

UnitQuaternion::Inverse UnitQuaternion::tangent_inverse_derivative(const Quaternion& /*p*/, const Quaternion& u) {
  return 0.25 * left_operator(u).transpose();
}

}  // namespace bielle::mechanism
