// Rigid motions: frames, exponential, logarithm and tangent operators of SE(3). Six-vectors are [u; psi], translation
// first.
//
//   exp6([u; psi]) = (T(psi)^T u, exp(psi)),   T6([u; psi]) = [[T, DT(psi)[u]], [0, T]],   Ad_H = [[R, x~ R], [0, R]]
//
// H = H_ref exp6(d) has the body velocity T6(d) ddot. Reference: V. Sonneville, A. Cardona, O. Bruls, CMAME 268 (2014)
// 451.
#pragma once

#include "mechanism/math/so3.hpp"

namespace bielle::mechanism {

/// A frame: `x` is its origin, `R` its axes, both in the components of the frame that it is given in.
struct Frame {
  Vector3 x = Vector3::Zero();
  Matrix3 R = Matrix3::Identity();
};

inline Frame operator*(const Frame& A, const Frame& B) { return {A.x + A.R * B.x, A.R * B.R}; }
inline Frame inverse(const Frame& H) { return {-(H.R.transpose() * H.x), H.R.transpose()}; }

Frame exp_se3(const Vector6& d);
Vector6 log_se3(const Frame& H);  ///< relative rotation up to pi (principal value)

Matrix6 tangent_se3(const Vector6& d);          ///< T6(d)
Matrix6 tangent_se3_inverse(const Vector6& d);  ///< T6^-1(d) = [[T^-1, DTinv(psi)[u]], [0, T^-1]]
Matrix6 adjoint(const Frame& H);                ///< Ad_H; Ad of exp6(d) is the matrix exponential of ad_d
Matrix6 little_adjoint(const Vector6& d);       ///< ad_d = [[psi~, u~], [0, psi~]], with ad_d e = -ad_e d

/// DT6(d)[e]: derivative of T6(d) along e = [u'; psi'], a matrix.
Matrix6 tangent_se3_derivative(const Vector6& d, const Vector6& e);

/// Derivative of T6^-1(d) along e = -T6^-1 DT6[e] T6^-1, a matrix. It is singular if T^-1 is.
Matrix6 tangent_se3_inverse_derivative(const Vector6& d, const Vector6& e);

/// G(d,f) = d(T6^-T(d) f)/dd at fixed f.
Matrix6 inverse_transpose_gradient_se3(const Vector6& d, const Vector6& f);

/// d(T6^-1(d) w)/dd at fixed w.
Matrix6 tangent_se3_inverse_gradient(const Vector6& d, const Vector6& w);

}  // namespace bielle::mechanism
