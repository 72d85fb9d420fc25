#include "mechanism/elements/superelement/interface_rotation.hpp"

#include <Eigen/Geometry>

#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {

/// tau = N / W with N = b.Ea - a.Eb, W = 1 + e.Ee, and its derivatives along rotations phi of E (dE = phi~ E): dN =
/// v_N.phi, d(v_N) = J_N phi, and the same for W; dtau = d.phi, d(d) = J phi.
struct InterfaceRotation::Twist {
  Vector3 Ea, Eb, Ee, v_N, v_W, d;
  Matrix3 J_N, J_W, J;
  double W, tau;
  Twist(const InterfaceRotation& r, const Matrix3& E) : Ea(E * r.a_), Eb(E * r.b_), Ee(E * r.e_) {
    W = 1 + r.e_.dot(Ee);
    tau = (r.b_.dot(Ea) - r.a_.dot(Eb)) / W;
    v_N = Ea.cross(r.b_) - Eb.cross(r.a_);
    v_W = Ee.cross(r.e_);
    d = (v_N - tau * v_W) / W;
    J_N = skew(r.b_) * skew(Ea) - skew(r.a_) * skew(Eb);
    J_W = skew(r.e_) * skew(Ee);
    J = (J_N - tau * J_W - v_W * d.transpose() - d * v_W.transpose()) / W;
  }
};

InterfaceRotation::InterfaceRotation(const Matrix3& axes, const std::array<bool, 3>& kept) {
  const int count = kept[0] + kept[1] + kept[2];
  kind_ = std::array{Kind::none, Kind::twist, Kind::tilt, Kind::vector}[static_cast<std::size_t>(count)];
  if (count == 1 || count == 2) {
    const bool single = count == 1;
    int k = 0;
    while (kept[static_cast<std::size_t>(k)] != single) ++k;
    e_ = axes.col(k);
    a_ = axes.col((k + 1) % 3);
    b_ = axes.col((k + 2) % 3);
  }
}

Vector3 InterfaceRotation::coordinate(const Matrix3& E) const {
  switch (kind_) {
    case Kind::vector:
      return log_so3(E);
    case Kind::tilt:
      return e_.cross(E * e_);
    case Kind::twist:
      return Twist(*this, E).tau * e_;
    case Kind::none:
      break;
  }
  return Vector3::Zero();
}

Matrix3 InterfaceRotation::differential(const Matrix3& E) const {
  switch (kind_) {
    case Kind::vector:
      return tangent_inverse(log_so3(E)).transpose();
    case Kind::tilt:
      return -skew(e_) * skew(E * e_);
    case Kind::twist:
      return e_ * Twist(*this, E).d.transpose();
    case Kind::none:
      break;
  }
  return Matrix3::Zero();
}

void InterfaceRotation::evaluate(const Matrix3& E, Eigen::Ref<Vector3> t, Matrix3& D) const {
  if (kind_ == Kind::vector) {
    const Vector3 theta = log_so3(E);
    t = theta;
    D = tangent_inverse(theta).transpose();
    return;
  }
  t = coordinate(E);
  D = differential(E);
}

Matrix3 InterfaceRotation::gradient(const Matrix3& E, const Vector3& r) const {
  switch (kind_) {
    case Kind::vector: {
      const Vector3 theta = log_so3(E);
      return inverse_transpose_gradient(theta, r) * tangent_inverse(theta).transpose();
    }
    case Kind::tilt:
      return -skew(e_) * skew(r) * skew(E * e_);
    case Kind::twist:
      return e_ * (Twist(*this, E).J.transpose() * r).transpose();
    case Kind::none:
      break;
  }
  return Matrix3::Zero();
}

Matrix3 InterfaceRotation::transpose_gradient(const Matrix3& E, const Vector3& m) const {
  switch (kind_) {
    case Kind::vector: {
      // D^T = T^-1(theta) = T^-T(-theta)
      const Vector3 theta = log_so3(E);
      return -inverse_transpose_gradient(-theta, m) * tangent_inverse(theta).transpose();
    }
    case Kind::tilt:
      return -skew(e_.cross(m)) * skew(E * e_);
    case Kind::twist:
      return e_.dot(m) * Twist(*this, E).J;
    case Kind::none:
      break;
  }
  return Matrix3::Zero();
}

Matrix3 InterfaceRotation::differential_rate(const Matrix3& E, const Vector3& r) const {
  switch (kind_) {
    case Kind::vector: {
      const Vector3 theta = log_so3(E);
      return tangent_inverse_derivative(theta, tangent_inverse(theta).transpose() * r).transpose();
    }
    case Kind::tilt:
      return -skew(e_) * skew(r.cross(E * e_));
    case Kind::twist:
      return e_ * (Twist(*this, E).J * r).transpose();
    case Kind::none:
      break;
  }
  return Matrix3::Zero();
}

Matrix3 InterfaceRotation::rate_gradient(const Matrix3& E, const Vector3& r) const {
  switch (kind_) {
    case Kind::vector: {
      // D' r = g(theta, r) D r with dtheta = D phi and d(D r) = g(theta, r) D phi
      const Vector3 theta = log_so3(E);
      const Matrix3 D = tangent_inverse(theta).transpose();
      const Matrix3 g = inverse_transpose_gradient(theta, r);
      return (inverse_transpose_hessian(theta, D * r, r) + g * g) * D;
    }
    case Kind::tilt:
      return -skew(e_) * skew(r) * skew(r) * skew(E * e_);
    case Kind::twist: {
      // e.D' r is the second derivative of tau = N/W along r: tau2 = (N2 - 2 tau1 W1 - tau W2) / W.
      const Twist t(*this, E);
      const Matrix3 rr = skew(r) * skew(r);
      const double tau1 = t.d.dot(r), W1 = t.v_W.dot(r), W2 = r.dot(t.J_W * r);
      const double tau2 = r.dot(t.J * r);
      const Vector3 N2_gradient = -(b_.transpose() * rr * skew(t.Ea) - a_.transpose() * rr * skew(t.Eb)).transpose();
      const Vector3 W2_gradient = -(e_.transpose() * rr * skew(t.Ee)).transpose();
      const Vector3 tau1_gradient = t.J.transpose() * r;
      const Vector3 W1_gradient = t.J_W.transpose() * r;
      const Vector3 tau2_gradient = (N2_gradient - 2 * W1 * tau1_gradient - 2 * tau1 * W1_gradient - W2 * t.d -
                                     t.tau * W2_gradient - tau2 * t.v_W) /
                                    t.W;
      return e_ * tau2_gradient.transpose();
    }
    case Kind::none:
      break;
  }
  return Matrix3::Zero();
}

}  // namespace bielle::mechanism
