#include "mechanism/math/se3.hpp"

namespace bielle::mechanism {

Frame exp_se3(const Vector6& d) {
  const Vector3 u = d.head<3>(), psi = d.tail<3>();
  return {tangent(psi).transpose() * u, exp_so3(psi)};
}

Vector6 log_se3(const Frame& H) {
  Vector6 d;
  const Vector3 psi = log_so3(H.R);
  d << tangent_inverse(psi).transpose() * H.x, psi;
  return d;
}

Matrix6 tangent_se3(const Vector6& d) {
  Matrix6 T6;
  const Matrix3 T = tangent(d.tail<3>());
  T6 << T, tangent_derivative(d.tail<3>(), d.head<3>()), Matrix3::Zero(), T;
  return T6;
}

Matrix6 tangent_se3_inverse(const Vector6& d) {
  Matrix6 inverse;
  const Vector3 u = d.head<3>(), psi = d.tail<3>();
  const InverseCoefficients c(psi.squaredNorm());
  const Matrix3 T = quadratic_in_skew(psi, 0.5, c.b);
  inverse << T, tangent_inverse_derivative(c, psi, u), Matrix3::Zero(), T;
  return inverse;
}

Matrix6 adjoint(const Frame& H) {
  Matrix6 Ad;
  Ad << H.R, skew(H.x) * H.R, Matrix3::Zero(), H.R;
  return Ad;
}

Matrix6 little_adjoint(const Vector6& d) {
  Matrix6 ad;
  const Matrix3 psi = skew(d.tail<3>());
  ad << psi, skew(d.head<3>()), Matrix3::Zero(), psi;
  return ad;
}

Matrix6 tangent_se3_derivative(const Vector6& d, const Vector6& e) {
  const Vector3 u = d.head<3>(), psi = d.tail<3>(), du = e.head<3>(), dpsi = e.tail<3>();
  const Matrix3 DT = tangent_derivative(psi, dpsi);
  Matrix6 D;
  D << DT, tangent_second_derivative(psi, u, dpsi) + tangent_derivative(psi, du), Matrix3::Zero(), DT;
  return D;
}

Matrix6 tangent_se3_inverse_derivative(const Vector6& d, const Vector6& e) {
  const Matrix6 inverse = tangent_se3_inverse(d);
  return -(inverse * tangent_se3_derivative(d, e) * inverse);
}

Matrix6 inverse_transpose_gradient_se3(const Vector6& d, const Vector6& f) {
  const Vector3 u = d.head<3>(), psi = d.tail<3>(), n = f.head<3>(), m = f.tail<3>();
  const InverseCoefficients c(psi.squaredNorm());
  const Matrix3 g = inverse_transpose_gradient(c, psi, n);
  Matrix6 G;
  G << Matrix3::Zero(), g, g, inverse_transpose_hessian(c, psi, u, n) + inverse_transpose_gradient(c, psi, m);
  return G;
}

Matrix6 tangent_se3_inverse_gradient(const Vector6& d, const Vector6& w) {
  // T^-1(psi) = T^-T(-psi): both derivatives are therefore those of the transposed inverse at -psi.
  const Vector3 u = d.head<3>(), psi = d.tail<3>(), a = w.head<3>(), c = w.tail<3>();
  const InverseCoefficients k(psi.squaredNorm());
  const Matrix3 gc = inverse_transpose_gradient(k, -psi, c);
  Matrix6 G;
  G << -gc, -inverse_transpose_gradient(k, -psi, a) + inverse_transpose_hessian(k, -psi, u, c), Matrix3::Zero(), -gc;
  return G;
}

}  // namespace bielle::mechanism
