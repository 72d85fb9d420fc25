// The rotational coordinates of an interface: a node's rotation relative to its body as a small local rotation.
//
// E (node axes of the undeformed body -> body axes, identity at rest) changes by dE = phi~ E. The coordinate t(E) is a
// vector in body axes, equal to the rotation vector of E to first order, whose kept components deform the body:
//   vector  all three rotations kept:       t = log E
//   tilt    all except that about e kept:   t = e x n, n = E e         (the node may spin about n freely)
//   twist   only that about e kept:         t = tau e, tau = (b.Ea - a.Eb) / (1 + e.Ee) = sine of the rotation about e
//                                           (a, b, e right-handed; the node may tilt freely)
//   none    the interface only transmits forces
// tilt and twist exclude the free rotation exactly, so that any number of turns about a free axis has no effect;
// components of log E would include it. The elastic model is linear in t: it is valid while the kept rotations are
// small (vector: |log E| < pi, tilt and twist: below a quarter turn).
#pragma once

#include <array>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

class InterfaceRotation {
 public:
  enum class Kind { none, vector, tilt, twist };

  InterfaceRotation() = default;
  /// @param axes  interface axes -> body axes
  /// @param kept  whether each rotation about them is kept
  InterfaceRotation(const Matrix3& axes, const std::array<bool, 3>& kept);

  Kind kind() const { return kind_; }
  /// e: the free axis of a tilt, the kept axis of a twist [body axes].
  const Vector3& axis() const { return e_; }

  /// Returns t(E) [rad], body axes.
  Vector3 coordinate(const Matrix3& E) const;
  /// Returns D(E): dt = D phi.
  Matrix3 differential(const Matrix3& E) const;
  /// Computes t(E) and D(E).
  void evaluate(const Matrix3& E, Eigen::Ref<Vector3> t, Matrix3& D) const;
  /// Returns d(D r)/dphi at fixed r.
  Matrix3 gradient(const Matrix3& E, const Vector3& r) const;
  /// Returns d(D^T m)/dphi at fixed m.
  Matrix3 transpose_gradient(const Matrix3& E, const Vector3& m) const;
  /// Returns the rate of D if E rotates with the angular velocity r (body axes): D' = dD/dphi [r].
  Matrix3 differential_rate(const Matrix3& E, const Vector3& r) const;
  /// Returns d(D' r)/dphi at fixed r.
  Matrix3 rate_gradient(const Matrix3& E, const Vector3& r) const;

 private:
  struct Twist;
  Kind kind_ = Kind::none;
  Vector3 a_ = Vector3::UnitX(), b_ = Vector3::UnitY(), e_ = Vector3::UnitZ();
};

}  // namespace bielle::mechanism
