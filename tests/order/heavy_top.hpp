// The heavy top of O. Bruls, A. Cardona, M. Arnold, Mech. Mach. Theory 48 (2012) 121: m = 15 kg, J = diag(0.234375,
// 0.46875, 0.234375) kg m^2 about the centre at (0, 1, 0), spinning at (0, 150, -4.61538) rad/s.
#pragma once

#include <algorithm>
#include <cmath>

#include "mechanism/math/so3.hpp"
#include "mechanism/model/state.hpp"

namespace bielle::test {

using mechanism::Matrix3;
using mechanism::skew;
using mechanism::Vector3;

inline const char* const heavy_top = R"yaml(
gravity: [0, 0, -9.81]
nodes: {top: {position: [0, 1, 0], velocity: [4.61538, 0, 0], angular_velocity: [0, 150, -4.61538]}}
elements: {top: {type: rigid_body, node: top, mass: 15, inertia: [0.234375, 0.46875, 0.234375]}}
joints: {pivot: {type: spherical, nodes: [ground, top], position: [0, 0, 0]}}
)yaml";

/// The top as a body about its fixed point (Euler-Poinsot), by the classical Runge-Kutta method: an independent
/// reference.
class EulerPoinsot {
 public:
  /// Advances by h in `steps` equal steps.
  void advance(double h, int steps) {
    const double e = h / steps;
    for (int k = 0; k < steps; ++k) {
      const Vector3 w1 = acceleration(R_, Omega_);
      const Vector3 O2 = Omega_ + e / 2 * w1;
      const Matrix3 R2 = R_ + e / 2 * R_ * skew(Omega_);
      const Vector3 w2 = acceleration(R2, O2);
      const Vector3 O3 = Omega_ + e / 2 * w2;
      const Matrix3 R3 = R_ + e / 2 * R2 * skew(O2);
      const Vector3 w3 = acceleration(R3, O3);
      const Vector3 O4 = Omega_ + e * w3;
      const Matrix3 R4 = R_ + e * R3 * skew(O3);
      const Vector3 w4 = acceleration(R4, O4);
      R_ += e / 6 * (R_ * skew(Omega_) + 2 * R2 * skew(O2) + 2 * R3 * skew(O3) + R4 * skew(O4));
      Omega_ += e / 6 * (w1 + 2 * w2 + 2 * w3 + w4);
    }
  }
  Vector3 centre() const { return R_ * Vector3(0, 1, 0); }
  const Vector3& Omega() const { return Omega_; }
  Vector3 velocity() const { return R_ * Omega_.cross(Vector3(0, 1, 0)); }
  /// Returns the force of the pivot on the body.
  Vector3 force() const {
    const Vector3 arm(0, 1, 0);
    const Vector3 a = R_ * (acceleration(R_, Omega_).cross(arm) + Omega_.cross(Omega_.cross(arm)));
    return 15 * (a - Vector3(0, 0, -9.81));
  }

 private:
  static Vector3 acceleration(const Matrix3& R, const Vector3& Omega) {
    const Vector3 J(15.234375, 0.46875, 15.234375), arm(0, 1, 0);
    const Vector3 weight = R.transpose() * Vector3(0, 0, -9.81 * 15);
    return (arm.cross(weight) - Omega.cross(J.cwiseProduct(Omega))).cwiseQuotient(J);
  }
  Matrix3 R_ = Matrix3::Identity();
  Vector3 Omega_{0, 150, -4.61538};
};

/// Largest errors of a computed top over the steps that were noted: of the centre's position, of all velocities, of the
/// multipliers (whose axes stay parallel to the inertial ones: the negative of the pivot's force on the top).
struct TopErrors {
  double x = 0, v = 0, lambda = 0;
  void note(const mechanism::NodeState& top, const mechanism::VectorX& multiplier, const EulerPoinsot& reference) {
    x = std::max(x, (top.x - reference.centre()).norm());
    v = std::max(v, std::hypot((top.v - reference.velocity()).norm(), (top.Omega - reference.Omega()).norm()));
    lambda = std::max(lambda, (-multiplier - reference.force()).norm());
  }
};

}  // namespace bielle::test
