#include "mechanism/math/so3.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

namespace bielle::mechanism {
namespace {

constexpr double series_limit = series_angle * series_angle;

/// Terms of sum_k (-x)^k c_k, Horner from the last; the coefficients hold their signs.
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

/// beta_k = |B_{2k+2}| / (2k+2)! = 2 zeta(2k+2) / (2 pi)^(2k+2)
std::array<double, inverse_terms> beta() {
  std::array<double, inverse_terms> c{};
  const double two_pi = 2 * M_PI;
  for (int k = 0; k < inverse_terms; ++k) {
    const int s = 2 * k + 2;
    double zeta = 0;
    if (k == 0) {
      zeta = M_PI * M_PI / 6;
    } else if (k == 1) {
      zeta = std::pow(M_PI, 4) / 90;
    } else {
      // Tail by the Euler-Maclaurin formula behind 40 terms: error below 1e-17.
      const int n = 40;
      zeta = std::pow(n, 1.0 - s) / (s - 1) + 0.5 * std::pow(n, -s) + s / 12.0 * std::pow(n, -s - 1.0);
      for (int j = n - 1; j >= 1; --j) zeta += std::pow(j, -s);
    }
    c[k] = 2 * zeta / std::pow(two_pi, s);
  }
  return c;
}

struct InverseSeries {
  std::array<double, inverse_terms> b{}, bp{}, bpp{};
  InverseSeries() {
    b = beta();
    // b = sum beta_k phi^2k; each division of a derivative by phi lowers the power by two.
    for (int k = 1; k < inverse_terms; ++k) bp[k - 1] = 2 * k * b[k];
    for (int k = 2; k < inverse_terms; ++k) bpp[k - 2] = 4.0 * k * (k - 1) * b[k];
  }
};

const InverseSeries inverse_series;

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
    b = horner(inverse_series.b, x);
    bp = horner(inverse_series.bp, x);
    bpp = horner(inverse_series.bpp, x);
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
