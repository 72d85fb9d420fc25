// Parameters along the axis of rotation: rotation vector, Rodrigues vector, conformal rotation vector. They are
// converted to and from R, and composed, through the unit quaternion, which loses no digits.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "mechanism/math/rotation_parameters.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

using Quaternion = UnitQuaternion::Parameters;

Quaternion with_parts(double w, const Vector3& e) {
  Quaternion q;
  q << w, e;
  return q;
}

Quaternion quaternion_of_rotation_vector(const Vector3& psi) {
  const double half = psi.norm() / 2;
  return with_parts(std::cos(half), 0.5 * ExpCoefficients(half * half).a1 * psi);
}

Vector3 rodrigues_of(const Quaternion& q) {
  // Beyond this bound all digits of the result would be rounding errors of q.
  constexpr double smallest_cosine = 4e-16;
  if (!(std::abs(q[0]) > smallest_cosine))
    throw ComputationError("a half turn has no Rodrigues vector: tan(phi/2) is infinite");
  return q.tail<3>() / q[0];
}

/// Returns (cos(phi/2), sin(phi/2) e), scaled by the larger of 1 and |g| so that no square overflows.
Quaternion quaternion_of_rodrigues(const Vector3& g) {
  const double scale = std::max(1.0, g.cwiseAbs().maxCoeff());
  if (!std::isfinite(scale)) throw ComputationError("a Rodrigues vector must be finite");
  return with_parts(1 / scale, g / scale);
}

/// Returns a multiple of the quaternion (2 - |c|^2/8, c), scaled so that no square overflows.
Quaternion quaternion_of_conformal(const Vector3& c) {
  const double scale = std::max(1.0, c.stableNorm());
  if (!std::isfinite(scale)) throw ComputationError("a conformal rotation vector must be finite");
  const Vector3 e = c / scale;
  return with_parts(2 / scale / scale - e.squaredNorm() / 8, e / scale);
}

Vector3 conformal_of(const Quaternion& principal) { return 4 * principal.tail<3>() / (1 + principal[0]); }

/// Throws if psi is so near to a full turn that less than half of the digits of T^-1 would be left: it has a pole of
/// 1/(2 pi n - |psi|).
void check_full_turns(const Vector3& psi) {
  constexpr double full = 2 * std::numbers::pi;
  const double turns = psi.norm() / full;
  if (!std::isfinite(turns)) throw ComputationError("a rotation vector must be finite");
  if (turns > 0.5 && std::abs(turns - std::round(turns)) < 1e-9)
    throw ComputationError(
        fmt::format("the rotation vector has turned by {:.0f} full turn(s), where its rates are not determined by the "
                    "angular velocity; use the principal rotation vector",
                    turns));
}

}  // namespace

// -- rotation vector

Matrix3 RotationVector::rotation(const Vector3& psi) { return exp_so3(psi); }

Vector3 RotationVector::parameters(const Matrix3& R) { return log_so3(R); }

Vector3 RotationVector::principal(const Vector3& psi) {
  constexpr double full = 2 * std::numbers::pi;
  const double angle = psi.norm();
  if (angle <= std::numbers::pi) return psi;
  return (std::remainder(angle, full) / angle) * psi;
}

Vector3 RotationVector::complement(const Vector3& psi) {
  const double angle = psi.norm();
  if (!(angle > 0 && std::isfinite(angle)))
    throw ComputationError("the rotation vector 0 has no complement: every vector of length 2 pi is one");
  return ((angle - 2 * std::numbers::pi) / angle) * psi;
}

Vector3 RotationVector::compose(const Vector3& psi, const Vector3& second) {
  return log_quaternion(
      UnitQuaternion::compose(quaternion_of_rotation_vector(psi), quaternion_of_rotation_vector(second)));
}

Matrix3 RotationVector::tangent(const Vector3& psi) { return mechanism::tangent(psi); }

Matrix3 RotationVector::tangent_inverse(const Vector3& psi) {
  check_full_turns(psi);
  return mechanism::tangent_inverse(psi);
}

Matrix3 RotationVector::tangent_derivative(const Vector3& psi, const Vector3& u) {
  return mechanism::tangent_derivative(psi, u);
}

Matrix3 RotationVector::tangent_inverse_derivative(const Vector3& psi, const Vector3& u) {
  check_full_turns(psi);
  return mechanism::tangent_inverse_derivative(psi, u);
}

// -- Rodrigues:  T = 2/(1 + g.g) (I - g~),  T^-1 = (I + g~ + g g^T)/2

Matrix3 RodriguesVector::rotation(const Vector3& g) { return rotation_of_quaternion(quaternion_of_rodrigues(g)); }

Vector3 RodriguesVector::parameters(const Matrix3& R) { return rodrigues_of(quaternion_of(R)); }

Vector3 RodriguesVector::principal(const Vector3& g) { return g; }

Vector3 RodriguesVector::complement(const Vector3& /*g*/) {
  throw ComputationError("a Rodrigues vector has no complement: it is the only one of its rotation");
}

Vector3 RodriguesVector::compose(const Vector3& g, const Vector3& second) {
  return rodrigues_of(UnitQuaternion::compose(quaternion_of_rodrigues(g), quaternion_of_rodrigues(second)));
}

Matrix3 RodriguesVector::tangent(const Vector3& g) {
  return (2 / (1 + g.squaredNorm())) * (Matrix3::Identity() - skew(g));
}

Matrix3 RodriguesVector::tangent_inverse(const Vector3& g) {
  return 0.5 * (Matrix3::Identity() + skew(g) + g * g.transpose());
}

Matrix3 RodriguesVector::tangent_derivative(const Vector3& g, const Vector3& u) {
  const double square = 1 + g.squaredNorm();
  return (-2 / square) * (skew(u) + (2 * g.dot(u) / square) * (Matrix3::Identity() - skew(g)));
}

Matrix3 RodriguesVector::tangent_inverse_derivative(const Vector3& g, const Vector3& u) {
  return 0.5 * (skew(u) + g * u.transpose() + u * g.transpose());
}

// -- conformal:  N = c0 I - c~ + c c^T/4,  T = 2/(4 - c0)^2 N,  T^-1 = N^T/2

Matrix3 ConformalVector::rotation(const Vector3& c) { return rotation_of_quaternion(quaternion_of_conformal(c)); }

Vector3 ConformalVector::parameters(const Matrix3& R) { return conformal_of(quaternion_of(R)); }

Vector3 ConformalVector::principal(const Vector3& c) {
  const double size = c.stableNorm();
  if (!std::isfinite(size)) throw ComputationError("a conformal rotation vector must be finite");
  return size <= 4 ? c : complement(c);
}

Vector3 ConformalVector::complement(const Vector3& c) {
  const double size = c.stableNorm();
  const Vector3 shadow = (-16 / size) * (c / size);
  if (!shadow.allFinite())
    throw ComputationError("the conformal rotation vector 0 has no complement: its shadow is infinite");
  return shadow;
}

Vector3 ConformalVector::compose(const Vector3& c, const Vector3& second) {
  return conformal_of(UnitQuaternion::compose(quaternion_of_conformal(c), quaternion_of_conformal(second)));
}

Matrix3 ConformalVector::tangent(const Vector3& c) {
  const double m = 2 + c.squaredNorm() / 8;  // 4 - c0
  return (4 / (m * m)) * tangent_inverse(c).transpose();
}

Matrix3 ConformalVector::tangent_inverse(const Vector3& c) {
  const double c0 = 2 - c.squaredNorm() / 8;
  return 0.5 * (c0 * Matrix3::Identity() + skew(c) + 0.25 * c * c.transpose());
}

Matrix3 ConformalVector::tangent_derivative(const Vector3& c, const Vector3& u) {
  const double m = 2 + c.squaredNorm() / 8;
  return (4 / (m * m)) *
         (tangent_inverse_derivative(c, u).transpose() - (c.dot(u) / (2 * m)) * tangent_inverse(c).transpose());
}

Matrix3 ConformalVector::tangent_inverse_derivative(const Vector3& c, const Vector3& u) {
  return 0.5 * (-0.25 * c.dot(u) * Matrix3::Identity() + skew(u) + 0.25 * (c * u.transpose() + u * c.transpose()));
}

}  // namespace bielle::mechanism
