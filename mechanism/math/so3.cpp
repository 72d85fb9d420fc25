#include "mechanism/math/so3.hpp"

#include <cmath>

#include "reduce/common/error.hpp"

namespace bielle::mechanism {

Eigen::Vector4d quaternion_of(const Matrix3& R) {
  // Spurrier's method divides by the largest of the four components.
  Eigen::Vector4d q;
  const double trace = R.trace();
  Eigen::Index i = 0;
  const double largest = R.diagonal().maxCoeff(&i);
  if (trace >= largest) {
    q[0] = 0.5 * std::sqrt(std::max(0.0, 1 + trace));
    q.tail<3>() = 0.5 * skew_vector(R) / q[0];
  } else {
    const Eigen::Index j = (i + 1) % 3, k = (i + 2) % 3;
    q[1 + i] = std::sqrt(std::max(0.0, 0.5 * largest + 0.25 * (1 - trace)));
    q[0] = 0.25 * (R(k, j) - R(j, k)) / q[1 + i];
    q[1 + j] = 0.25 * (R(j, i) + R(i, j)) / q[1 + i];
    q[1 + k] = 0.25 * (R(k, i) + R(i, k)) / q[1 + i];
  }
  q.normalize();
  return q[0] < 0 ? Eigen::Vector4d(-q) : q;
}

Matrix3 rotation_of_quaternion(const Eigen::Vector4d& quaternion) {
  const double norm = quaternion.norm();
  if (!(norm > 0 && std::isfinite(norm)))
    throw ComputationError("a quaternion whose length is zero or not finite stands for no rotation");
  const Eigen::Vector4d q = quaternion / norm;
  const Vector3 e = q.tail<3>();
  return (2 * q[0] * q[0] - 1) * Matrix3::Identity() + 2 * e * e.transpose() + 2 * q[0] * skew(e);
}

Vector3 log_so3(const Matrix3& R) { return log_quaternion(quaternion_of(R)); }

Vector3 log_quaternion(const Eigen::Vector4d& q) {
  const Vector3 e = q.tail<3>();
  const double sine = e.norm();
  if (sine < 1e-8) return 2 * e;  // 2 asin(s)/s = 2 + s^2/3: exact to rounding for such s
  return (2 * std::atan2(sine, q[0]) / sine) * e;
}

Matrix3 tangent_inverse(const Vector3& psi) {
  const InverseCoefficients c(psi.squaredNorm());
  return quadratic_in_skew(psi, 0.5, c.b);
}

Matrix3 tangent_derivative(const Vector3& psi, const Vector3& u) {
  const ExpCoefficients c(psi.squaredNorm());
  const Matrix3 s = skew(psi), v = skew(u);
  return -c.a2 * v + c.a3 * (s * v + v * s) - psi.dot(u) * (c.c1 * s - c.c2 * s * s);
}

Matrix3 tangent_second_derivative(const Vector3& psi, const Vector3& u, const Vector3& w) {
  const ExpCoefficients c(psi.squaredNorm());
  const ExpSecondCoefficients d(psi.squaredNorm());
  const Matrix3 s = skew(psi), v = skew(u), z = skew(w);
  const Matrix3 ss = s * s;
  const double pu = psi.dot(u), pw = psi.dot(w);
  return -c.c1 * (pw * v + pu * z + u.dot(w) * s) +
         c.c2 * (pw * (s * v + v * s) + pu * (s * z + z * s) + u.dot(w) * ss) + c.a3 * (v * z + z * v) -
         pu * pw * (d.d1 * s - d.d2 * ss);
}

// psi~ u~ + u~ psi~ = psi u^T + u psi^T - 2 (psi.u) 1
Matrix3 tangent_inverse_derivative(const InverseCoefficients& c, const Vector3& psi, const Vector3& u) {
  const double pu = psi.dot(u);
  const Vector3 w = c.b * u + (0.5 * c.bp * pu) * psi;
  Matrix3 D = psi * w.transpose() + w * psi.transpose() + 0.5 * skew(u);
  D.diagonal().array() -= 2 * psi.dot(w);
  return D;
}

Matrix3 inverse_transpose_gradient(const InverseCoefficients& k, const Vector3& psi, const Vector3& n) {
  const Vector3 c = psi * psi.dot(n) - n * psi.squaredNorm();
  Matrix3 g = 0.5 * skew(n) + k.b * (psi * n.transpose() - 2 * n * psi.transpose()) + k.bp * c * psi.transpose();
  g.diagonal().array() += k.b * psi.dot(n);
  return g;
}

Matrix3 inverse_transpose_hessian(const InverseCoefficients& k, const Vector3& psi, const Vector3& u,
                                  const Vector3& n) {
  const double pn = psi.dot(n), pu = psi.dot(u), un = u.dot(n);
  const Vector3 c = psi * pn - n * psi.squaredNorm();
  const Vector3 w = psi * un + u * pn - 2 * n * pu;
  Matrix3 h = k.b * (u * n.transpose() - 2 * n * u.transpose()) +
              k.bp * (w * psi.transpose() + pu * (psi * n.transpose() - 2 * n * psi.transpose()) + c * u.transpose()) +
              (k.bpp * pu) * c * psi.transpose();
  h.diagonal().array() += k.b * un + k.bp * pu * pn;
  return h;
}

}  // namespace bielle::mechanism
