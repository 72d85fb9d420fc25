// Six ways to write a rotation in numbers, all with the same functions.
//
//   struct            parameters p                     singular                         there
//   RotationVector    psi = phi e                      |psi| = 2 pi, 4 pi, ...: T^-1    throws; `principal` avoids it
//   UnitQuaternion    cos(phi/2), sin(phi/2) e         never                            p = 0 throws
//   RodriguesVector   tan(phi/2) e                     half turns have no p             throws
//   ConformalVector   4 tan(phi/4) e                   full turns have no p             `principal`: never
//   EulerAngles       a, b, c: Rz(a) Rx(b) Rz(c)       sin b = 0: a and c alike         R -> p: c = 0; T^-1 throws
//   BryantAngles      a, b, c: Rx(a) Ry(b) Rz(c)       cos b = 0: a and c alike         R -> p: c = 0; T^-1 throws
// e is the axis and phi the angle of R = exp(phi e~). "Throws" is a ComputationError that names parameters and place.
//
// Each struct offers
//   rotation(p)                            R
//   parameters(R)                          p of R, the principal ones
//   principal(p)                           other parameters of the same rotation in the principal domain (below)
//   complement(p)                          the other parameters of the same rotation, those that stay regular where p
//                                          comes close to full turns; of three angles those beyond the singularity
//   compose(p, q)                          principal parameters of R(p) R(q)
//   tangent(p)                             T: body angular velocity Omega = T pdot
//   tangent_inverse(p)                     T^-1: pdot = T^-1 Omega
//   tangent_derivative(p, u)               derivative of T along u
//   tangent_inverse_derivative(p, u)       derivative of T^-1 along u
// and the templates below take rates and accelerations both ways.
//
// References: M. Geradin, A. Cardona, Flexible Multibody Dynamics (Wiley, 2001), ch. 4; O. A. Bauchau, L. Trainelli,
// Nonlinear Dynamics 32 (2003) 71 (vectorial parametrisations, rescaling).
#pragma once

#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {

/// psi = phi e [rad]; principal: |psi| <= pi, where at pi the sign of the axis is arbitrary.
/// Complement: (phi - 2 pi) e, the same rotation the other way round; of psi = 0, without an axis, it throws.
struct RotationVector {
  using Parameters = Vector3;
  using Tangent = Matrix3;
  using Inverse = Matrix3;
  static Matrix3 rotation(const Vector3& psi);
  static Vector3 parameters(const Matrix3& R);
  static Vector3 principal(const Vector3& psi);
  static Vector3 complement(const Vector3& psi);
  static Vector3 compose(const Vector3& psi, const Vector3& second);
  static Matrix3 tangent(const Vector3& psi);
  static Matrix3 tangent_inverse(const Vector3& psi);
  static Matrix3 tangent_derivative(const Vector3& psi, const Vector3& u);
  static Matrix3 tangent_inverse_derivative(const Vector3& psi, const Vector3& u);
};

/// Euler parameters (w, x, y, z) = (cos(phi/2), sin(phi/2) e); principal: length 1, w >= 0.
/// Any other length stands for the same rotation: T is that of p/|p|, and T^-1 gives rates that keep the length.
/// Complement: -p.
struct UnitQuaternion {
  using Parameters = Eigen::Vector4d;
  using Tangent = Eigen::Matrix<double, 3, 4>;
  using Inverse = Eigen::Matrix<double, 4, 3>;
  static Matrix3 rotation(const Parameters& p);
  static Parameters parameters(const Matrix3& R);
  static Parameters principal(const Parameters& p);
  static Parameters complement(const Parameters& p);
  static Parameters compose(const Parameters& p, const Parameters& second);
  static Tangent tangent(const Parameters& p);
  static Inverse tangent_inverse(const Parameters& p);
  static Tangent tangent_derivative(const Parameters& p, const Parameters& u);
  static Inverse tangent_inverse_derivative(const Parameters& p, const Parameters& u);
};

/// g = tan(phi/2) e: no trigonometry anywhere, but half turns lie at infinity (and 1/(pi - phi) digits are lost
/// before); principal: all. A rotation has one such vector alone, and `complement` throws.
struct RodriguesVector {
  using Parameters = Vector3;
  using Tangent = Matrix3;
  using Inverse = Matrix3;
  static Matrix3 rotation(const Vector3& g);
  static Vector3 parameters(const Matrix3& R);
  static Vector3 principal(const Vector3& g);
  static Vector3 complement(const Vector3& g);
  static Vector3 compose(const Vector3& g, const Vector3& second);
  static Matrix3 tangent(const Vector3& g);
  static Matrix3 tangent_inverse(const Vector3& g);
  static Matrix3 tangent_derivative(const Vector3& g, const Vector3& u);
  static Matrix3 tangent_inverse_derivative(const Vector3& g, const Vector3& u);
};

/// Wiener-Milenkovic: c = 4 tan(phi/4) e; principal: |c| <= 4 (phi <= pi). A motion that leaves this ball enters it
/// again at the shadow -16 c/|c|^2 of the same rotation, its complement: with that rescaling it is free of
/// singularities. The shadow of c = 0 is infinite, and `complement` throws.
struct ConformalVector {
  using Parameters = Vector3;
  using Tangent = Matrix3;
  using Inverse = Matrix3;
  static Matrix3 rotation(const Vector3& c);
  static Vector3 parameters(const Matrix3& R);
  static Vector3 principal(const Vector3& c);
  static Vector3 complement(const Vector3& c);
  static Vector3 compose(const Vector3& c, const Vector3& second);
  static Matrix3 tangent(const Vector3& c);
  static Matrix3 tangent_inverse(const Vector3& c);
  static Matrix3 tangent_derivative(const Vector3& c, const Vector3& u);
  static Matrix3 tangent_inverse_derivative(const Vector3& c, const Vector3& u);
};

/// (a, b, c) [rad] with R = Rz(a) Rx(b) Rz(c); principal: a, c in (-pi, pi], b in [0, pi].
/// At b = 0 and pi only a + c or a - c is determined: `parameters` gives it to a. T is singular there.
/// Complement: (a +- pi, -b, c +- pi), each half turn towards zero.
struct EulerAngles {
  using Parameters = Vector3;
  using Tangent = Matrix3;
  using Inverse = Matrix3;
  static Matrix3 rotation(const Vector3& angles);
  static Vector3 parameters(const Matrix3& R);
  static Vector3 principal(const Vector3& angles);
  static Vector3 complement(const Vector3& angles);
  static Vector3 compose(const Vector3& angles, const Vector3& second);
  static Matrix3 tangent(const Vector3& angles);
  static Matrix3 tangent_inverse(const Vector3& angles);
  static Matrix3 tangent_derivative(const Vector3& angles, const Vector3& u);
  static Matrix3 tangent_inverse_derivative(const Vector3& angles, const Vector3& u);
};

/// Cardan angles (a, b, c) [rad] with R = Rx(a) Ry(b) Rz(c); principal: a, c in (-pi, pi], b in [-pi/2, pi/2].
/// At b = +-pi/2 only a +- c is determined: `parameters` gives it to a. T is singular there.
/// Complement: (a +- pi, pi - b, c +- pi), each half turn towards zero.
struct BryantAngles {
  using Parameters = Vector3;
  using Tangent = Matrix3;
  using Inverse = Matrix3;
  static Matrix3 rotation(const Vector3& angles);
  static Vector3 parameters(const Matrix3& R);
  static Vector3 principal(const Vector3& angles);
  static Vector3 complement(const Vector3& angles);
  static Vector3 compose(const Vector3& angles, const Vector3& second);
  static Matrix3 tangent(const Vector3& angles);
  static Matrix3 tangent_inverse(const Vector3& angles);
  static Matrix3 tangent_derivative(const Vector3& angles, const Vector3& u);
  static Matrix3 tangent_inverse_derivative(const Vector3& angles, const Vector3& u);
};

/// Omega = T pdot [rad/s], body axes.
template <class P>
Vector3 angular_velocity(const typename P::Parameters& p, const typename P::Parameters& rate) {
  return P::tangent(p) * rate;
}

/// Omegadot = T pddot + Tdot pdot [rad/s^2], body axes.
template <class P>
Vector3 angular_acceleration(const typename P::Parameters& p, const typename P::Parameters& rate,
                             const typename P::Parameters& acceleration) {
  return P::tangent(p) * acceleration + P::tangent_derivative(p, rate) * rate;
}

/// pdot = T^-1 Omega. @throws ComputationError where T is singular
template <class P>
typename P::Parameters parameter_rate(const typename P::Parameters& p, const Vector3& Omega) {
  return P::tangent_inverse(p) * Omega;
}

/// pddot = T^-1 Omegadot + d(T^-1)/dt Omega. @throws ComputationError where T is singular
template <class P>
typename P::Parameters parameter_acceleration(const typename P::Parameters& p, const Vector3& Omega,
                                              const Vector3& Omegadot) {
  const typename P::Inverse inverse = P::tangent_inverse(p);
  return inverse * Omegadot + P::tangent_inverse_derivative(p, inverse * Omega) * Omega;
}

}  // namespace bielle::mechanism
