// Finite rotations by rotation vectors: exponential, logarithm and tangent operators of SO(3).
//
//   exp(psi) = I + a1 psi~ + a2 psi~^2,   T(psi) = I - a2 psi~ + a3 psi~^2,   T^-1(psi) = I + psi~/2 + b psi~^2
//
// with phi = |psi|, a1 = sin(phi)/phi, a2 = (1 - cos phi)/phi^2, a3 = (phi - sin phi)/phi^3, b = (1 - (phi/2)
// cot(phi/2))/phi^2. R maps body components to inertial ones; R = R_ref exp(psi) has the body angular velocity Omega =
// T(psi) psidot. Reference: M. Geradin, A. Cardona, Flexible Multibody Dynamics (Wiley, 2001), ch. 4. The scalar
// functions of phi are those of rotation_coefficients.hpp: accurate to a few rounding errors at every angle.
#pragma once

#include <numbers>

#include "mechanism/math/rotation_coefficients.hpp"
#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// a~, with a~ b = a x b.
inline Matrix3 skew(const Vector3& a) {
  Matrix3 s;
  s << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return s;
}

/// Converts radians to degrees.
inline double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// Returns the vector a of the skew part of A: (A - A^T)/2 = a~.
inline Vector3 skew_vector(const Matrix3& A) {
  return 0.5 * Vector3(A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1));
}

/// 1 + p psi~ + q psi~ psi~, computed by entries because inner loops use it often.
inline Matrix3 quadratic_in_skew(const Vector3& psi, double p, double q) {
  const double x = psi[0], y = psi[1], z = psi[2];
  const double xy = q * x * y, xz = q * x * z, yz = q * y * z, xx = q * x * x, yy = q * y * y, zz = q * z * z;
  Matrix3 A;
  A << 1 - (yy + zz), xy - p * z, xz + p * y,  //
      xy + p * z, 1 - (xx + zz), yz - p * x,   //
      xz - p * y, yz + p * x, 1 - (xx + yy);
  return A;
}

inline Matrix3 exp_so3(const Vector3& psi) {
  const ExpCoefficients c(psi.squaredNorm());
  return quadratic_in_skew(psi, c.a1, c.a2);
}

/// Rotation vector of R, 0 <= |psi| <= pi, through the unit quaternion (Spurrier); at pi the sign of the axis is
/// arbitrary.
Vector3 log_so3(const Matrix3& R);

/// T(psi)
inline Matrix3 tangent(const Vector3& psi) {
  const ExpCoefficients c(psi.squaredNorm());
  return quadratic_in_skew(psi, -c.a2, c.a3);
}

Matrix3 tangent_inverse(const Vector3& psi);  ///< T^-1(psi); singular at |psi| = 2 pi

/// DT(psi)[u]: derivative of T(psi) along u, a matrix.
Matrix3 tangent_derivative(const Vector3& psi, const Vector3& u);

/// D2T(psi)[u, w]: derivative of DT(psi)[u] along w, symmetric in u and w.
Matrix3 tangent_second_derivative(const Vector3& psi, const Vector3& u, const Vector3& w);

// The following functions take the coefficients of psi from a caller that computes several of them.

/// DTinv(psi)[u]: derivative of T^-1(psi) along u = -T^-1 DT[u] T^-1, a matrix.
Matrix3 tangent_inverse_derivative(const InverseCoefficients& of_psi, const Vector3& psi, const Vector3& u);
inline Matrix3 tangent_inverse_derivative(const Vector3& psi, const Vector3& u) {
  return tangent_inverse_derivative(InverseCoefficients(psi.squaredNorm()), psi, u);
}

/// g(psi,n) = d(T^-T(psi) n)/dpsi, n fixed.
Matrix3 inverse_transpose_gradient(const InverseCoefficients& of_psi, const Vector3& psi, const Vector3& n);
inline Matrix3 inverse_transpose_gradient(const Vector3& psi, const Vector3& n) {
  return inverse_transpose_gradient(InverseCoefficients(psi.squaredNorm()), psi, n);
}

/// h(psi,u,n) = d(g(psi,n) u)/dpsi, n and u fixed.
Matrix3 inverse_transpose_hessian(const InverseCoefficients& of_psi, const Vector3& psi, const Vector3& u,
                                  const Vector3& n);
inline Matrix3 inverse_transpose_hessian(const Vector3& psi, const Vector3& u, const Vector3& n) {
  return inverse_transpose_hessian(InverseCoefficients(psi.squaredNorm()), psi, u, n);
}

/// Unit quaternion (w, x, y, z) of R, w >= 0.
Eigen::Vector4d quaternion_of(const Matrix3& R);
/// R of a quaternion (w, x, y, z), normalised first. @throws ComputationError if its length is zero or not finite
Matrix3 rotation_of_quaternion(const Eigen::Vector4d& quaternion);
/// Rotation vector of a unit quaternion with w >= 0.
Vector3 log_quaternion(const Eigen::Vector4d& q);

}  // namespace bielle::mechanism
