#include "mechanism/math/so3.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

namespace bielle::mechanism {
namespace {

constexpr double series_limit = series_angle * series_angle;

/// sum_k c_k x^k
template <std::size_t N>
double horner(const std::array<double, N>& c, double x) {
  double sum = c[N - 1];
  for (std::size_t k = N - 1; k-- > 0;) sum = sum * x + c[k];
  return sum;
}

constexpr double factorial(int n) {
  double f = 1;
  for (int k = 2; k <= n; ++k) f *= k;
  return f;
}

constexpr int exp_terms = 11;

/// (-1)^k / (2k + offset)!
constexpr std::array<double, exp_terms> exp_series(int offset) {
  std::array<double, exp_terms> c{};
  for (int k = 0; k < exp_terms; ++k) c[k] = (k % 2 ? -1.0 : 1.0) / factorial(2 * k + offset);
  return c;
}

/// c1 (p = 1, w = 2) and c2 (p = 2, w = 3): sum_{k>=1} (-1)^k phi^(2k-2) (1/(2k+p)! - w/(2k+p+1)!)
constexpr std::array<double, exp_terms> difference_series(int p, double w) {
  std::array<double, exp_terms> c{};
  for (int k = 1; k <= exp_terms; ++k)
    c[k - 1] = (k % 2 ? -1.0 : 1.0) * (1 / factorial(2 * k + p) - w / factorial(2 * k + p + 1));
  return c;
}

constexpr auto a1_series = exp_series(1), a2_series = exp_series(2), a3_series = exp_series(3);
constexpr auto c1_series = difference_series(1, 2), c2_series = difference_series(2, 3);

constexpr int inverse_terms = 21;

/// beta_k = |B_{2k+2}| / (2k+2)! = 1/12, 1/720, 1/30240, ... by the recurrence (2k+3) beta_k = sum_{j<k} beta_j
/// beta_{k-1-j}, which follows from cot' = -1 - cot^2 and has positive terms only.
constexpr std::array<double, inverse_terms> beta_series() {
  std::array<double, inverse_terms> beta{1.0 / 12};
  for (int k = 1; k < inverse_terms; ++k) {
    for (int j = 0; j < k; ++j) beta[k] += beta[j] * beta[k - 1 - j];
    beta[k] /= 2 * k + 3;
  }
  return beta;
}

/// Coefficients of f'/phi from those of f, both in powers of phi^2.
template <std::size_t N>
constexpr std::array<double, N - 1> derivative_series(const std::array<double, N>& f) {
  std::array<double, N - 1> d{};
  for (std::size_t k = 1; k < N; ++k) d[k - 1] = 2.0 * k * f[k];
  return d;
}

constexpr auto b_series = beta_series();
constexpr auto bp_series = derivative_series(b_series);
constexpr auto bpp_series = derivative_series(bp_series);

}  // namespace

ExpCoefficients::ExpCoefficients(double x) {
  if (x < series_limit) {
    a1 = horner(a1_series, x);
    a2 = horner(a2_series, x);
    a3 = horner(a3_series, x);
    c1 = horner(c1_series, x);
    c2 = horner(c2_series, x);
    return;
  }
  const double phi = std::sqrt(x);
  const double half = std::sin(phi / 2);
  a1 = std::sin(phi) / phi;
  a2 = 2 * half * half / x;
  a3 = (phi - std::sin(phi)) / (phi * x);
  c1 = (a1 - 2 * a2) / x;
  c2 = (a2 - 3 * a3) / x;
}

InverseCoefficients::InverseCoefficients(double x) {
  if (x < series_limit) {
    b = horner(b_series, x);
    bp = horner(bp_series, x);
    bpp = horner(bpp_series, x);
    return;
  }
  const double half = std::sqrt(x) / 2;
  const double g = half / std::tan(half);
  const double ratio = half / std::sin(half);
  const double q = ratio * ratio;
  b = (1 - g) / x;
  bp = ((q - g) / x - 2 * b) / x;
  bpp = ((2 * q * (1 - g) + g - q) - 4 * (q + g - 2)) / (x * x * x);
}

Matrix3 exp_so3(const Vector3& psi) {
  const ExpCoefficients c(psi.squaredNorm());
  const Matrix3 s = skew(psi);
  return Matrix3::Identity() + c.a1 * s + c.a2 * s * s;
}

Eigen::Vector4d quaternion_of(const Matrix3& R) {
  // Spurrier: divide by the largest of the four components.
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
  if (!(norm > 0)) throw std::domain_error("a quaternion of length zero is no rotation");
  const Eigen::Vector4d q = quaternion / norm;
  const Vector3 e = q.tail<3>();
  return (2 * q[0] * q[0] - 1) * Matrix3::Identity() + 2 * e * e.transpose() + 2 * q[0] * skew(e);
}

Vector3 log_so3(const Matrix3& R) {
  const Eigen::Vector4d q = quaternion_of(R);
  const Vector3 e = q.tail<3>();
  const double sine = e.norm();
  if (sine < 1e-8) return 2 * e;  // 2 asin(s)/s = 2 + s^2/3: exact to rounding here
  return (2 * std::atan2(sine, q[0]) / sine) * e;
}

Matrix3 tangent(const Vector3& psi) {
  const ExpCoefficients c(psi.squaredNorm());
  const Matrix3 s = skew(psi);
  return Matrix3::Identity() - c.a2 * s + c.a3 * s * s;
}

Matrix3 tangent_inverse(const Vector3& psi) {
  const InverseCoefficients c(psi.squaredNorm());
  const Matrix3 s = skew(psi);
  return Matrix3::Identity() + 0.5 * s + c.b * s * s;
}

Matrix3 tangent_derivative(const Vector3& psi, const Vector3& u) {
  const ExpCoefficients c(psi.squaredNorm());
  const Matrix3 s = skew(psi), v = skew(u);
  return -c.a2 * v + c.a3 * (s * v + v * s) - psi.dot(u) * (c.c1 * s - c.c2 * s * s);
}

Matrix3 tangent_inverse_derivative(const Vector3& psi, const Vector3& u) {
  const InverseCoefficients c(psi.squaredNorm());
  const Matrix3 s = skew(psi), v = skew(u);
  return 0.5 * v + c.b * (s * v + v * s) + (c.bp * psi.dot(u)) * s * s;
}

Matrix3 inverse_transpose_gradient(const Vector3& psi, const Vector3& n) {
  const InverseCoefficients k(psi.squaredNorm());
  const Vector3 c = psi * psi.dot(n) - n * psi.squaredNorm();
  Matrix3 g = 0.5 * skew(n) + k.b * (psi * n.transpose() - 2 * n * psi.transpose()) + k.bp * c * psi.transpose();
  g.diagonal().array() += k.b * psi.dot(n);
  return g;
}

Matrix3 inverse_transpose_hessian(const Vector3& psi, const Vector3& u, const Vector3& n) {
  const InverseCoefficients k(psi.squaredNorm());
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
