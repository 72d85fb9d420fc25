// Forward automatic differentiation: numbers that carry their derivatives along N increments dz,
//
//     df = g . dz,   dg = S dz     (S at order 2 only).
//
// S need not be symmetric: increments of rotations do not commute. The rules of products and compositions hold all the
// same,
//     S(f h) = f S_h + h S_f + g_f g_h^T + g_h g_f^T,    S(p(f)) = p' S_f + p'' g_f g_f^T,
// because each is linear in the second derivatives and symmetric in its other terms. A formula that is a template of
// its number gives values with `double`, and exact derivatives with `AutoDiff`. It branches by values alone.
#pragma once

#include <cmath>
#include <type_traits>

#include <Eigen/Core>

namespace bielle {

template <int N, int most>
struct NoSecond {};

template <int N, int most>
struct WithSecond {
  using Matrix = Eigen::Matrix<double, N, N, 0, most, most>;
  Matrix second = Matrix::Zero();  ///< S
};

template <int N, int order, int most>
using SecondDerivatives = std::conditional_t<order == 2, WithSecond<N, most>, NoSecond<N, most>>;

/// @tparam N      number of increments; Eigen::Dynamic: at most `most`, or none for constants (order 1 only)
/// @tparam order  1 or 2
template <int N, int order, int most = N>
struct AutoDiff : SecondDerivatives<N, order, most> {
  static_assert(order == 1 || (order == 2 && N != Eigen::Dynamic));
  static constexpr bool is_dynamic = N == Eigen::Dynamic;
  using Gradient = Eigen::Matrix<double, N, 1, 0, most, 1>;

  double value = 0;
  Gradient gradient = no_gradient();  ///< g

  AutoDiff() = default;
  AutoDiff(double constant) : value(constant) {}  // NOLINT: constants are numbers
  AutoDiff(double v, const Gradient& g) : value(v), gradient(g) {}
  template <class Matrix>
  requires(order == 2) AutoDiff(double v, const Gradient& g, const Matrix& S)
      : SecondDerivatives<N, order, most>{S}, value(v), gradient(g) {}

  /// Derivatives with respect to time along a motion with rates v and accelerations a: fdot = g . v, fddot = g . a + v
  /// . S v.
  double rate(const Gradient& v) const { return gradient.dot(v); }
  double acceleration(const Gradient& v, const Gradient& a) const requires(order == 2) {
    return gradient.dot(a) + v.dot(this->second * v);
  }

  AutoDiff& operator+=(const AutoDiff& b) {
    value += b.value;
    if (is_constant(b)) return *this;
    if (is_constant(*this))
      gradient = b.gradient;
    else
      gradient += b.gradient;
    if constexpr (order == 2) this->second += b.second;
    return *this;
  }
  AutoDiff& operator-=(const AutoDiff& b) {
    value -= b.value;
    if (is_constant(b)) return *this;
    if (is_constant(*this))
      gradient = -b.gradient;
    else
      gradient -= b.gradient;
    if constexpr (order == 2) this->second -= b.second;
    return *this;
  }
  AutoDiff& operator+=(double constant) {
    value += constant;
    return *this;
  }
  AutoDiff& operator-=(double constant) { return *this += -constant; }
  AutoDiff& operator*=(double factor) {
    value *= factor;
    gradient *= factor;
    if constexpr (order == 2) this->second *= factor;
    return *this;
  }
  AutoDiff& operator*=(const AutoDiff& b) { return *this = *this * b; }

  friend AutoDiff operator+(AutoDiff a, const AutoDiff& b) { return a += b; }
  friend AutoDiff operator-(AutoDiff a, const AutoDiff& b) { return a -= b; }
  friend AutoDiff operator+(AutoDiff a, double constant) { return a += constant; }
  friend AutoDiff operator-(AutoDiff a, double constant) { return a -= constant; }
  friend AutoDiff operator*(double factor, AutoDiff a) { return a *= factor; }
  friend AutoDiff operator-(AutoDiff a) { return a *= -1; }
  friend AutoDiff operator*(const AutoDiff& a, const AutoDiff& b) {
    AutoDiff product = compose_first(a, b, a.value * b.value, b.value, a.value);
    if constexpr (order == 2) {
      product.second.noalias() = a.gradient * b.gradient.transpose();
      product.second.noalias() += b.gradient * a.gradient.transpose();
      product.second += b.value * a.second + a.value * b.second;
    }
    return product;
  }
  /// @param b  not zero
  friend AutoDiff operator/(const AutoDiff& a, const AutoDiff& b) {
    const double q = a.value / b.value, i = 1 / b.value;
    return compose(a, b, q, i, -q * i, 0, -i * i, 2 * q * i * i);
  }

 private:
  static Gradient no_gradient() {
    if constexpr (is_dynamic)
      return Gradient();
    else
      return Gradient::Zero();
  }
  /// Tells whether a number with a dynamic number of increments is a constant, which has no gradient.
  static bool is_constant(const AutoDiff& a) { return is_dynamic && a.gradient.size() == 0; }
};

// A formula that is a template of its number type calls these functions for `double` and for `AutoDiff`.
using std::atan2;
using std::pow;
using std::sqrt;

inline double value_of(double a) { return a; }
template <int N, int order, int most>
double value_of(const AutoDiff<N, order, most>& a) {
  return a.value;
}

/// Returns a function p(f). @param p,p1,p2  the function and its first two derivatives at f
inline double compose(double /*f*/, double p, double /*p1*/, double /*p2*/ = 0) { return p; }
template <int N, int order, int most>
AutoDiff<N, order, most> compose(const AutoDiff<N, order, most>& f, double p, double p1, double p2 = 0) {
  AutoDiff<N, order, most> result;
  result.value = p;
  result.gradient = p1 * f.gradient;
  if constexpr (order == 2) {
    result.second.noalias() = (p2 * f.gradient) * f.gradient.transpose();
    result.second += p1 * f.second;
  }
  return result;
}

/// Value and gradient of a function p(f, h).
template <int N, int order, int most>
AutoDiff<N, order, most> compose_first(const AutoDiff<N, order, most>& f, const AutoDiff<N, order, most>& h, double p,
                                       double p_f, double p_h) {
  AutoDiff<N, order, most> result;
  result.value = p;
  if constexpr (N == Eigen::Dynamic) {
    if (h.gradient.size() == 0) return compose(f, p, p_f);
    if (f.gradient.size() == 0) return compose(h, p, p_h);
  }
  result.gradient = p_f * f.gradient + p_h * h.gradient;
  return result;
}

/// Returns a function p(f, h). @param p_f,..  partial derivatives at (f, h)
template <int N, int order, int most>
AutoDiff<N, order, most> compose(const AutoDiff<N, order, most>& f, const AutoDiff<N, order, most>& h, double p,
                                 double p_f, double p_h, double p_ff = 0, double p_fh = 0, double p_hh = 0) {
  AutoDiff<N, order, most> result = compose_first(f, h, p, p_f, p_h);
  if constexpr (order == 2) {
    using Gradient = typename AutoDiff<N, order, most>::Gradient;
    const Gradient by_f = p_ff * f.gradient + p_fh * h.gradient, by_h = p_fh * f.gradient + p_hh * h.gradient;
    result.second.noalias() = by_f * f.gradient.transpose();
    result.second.noalias() += by_h * h.gradient.transpose();
    result.second += p_f * f.second + p_h * h.second;
  }
  return result;
}

template <int N, int order, int most>
AutoDiff<N, order, most> square(const AutoDiff<N, order, most>& f) {
  return compose(f, f.value * f.value, 2 * f.value, 2);
}
/// @param f  positive
template <int N, int order, int most>
AutoDiff<N, order, most> sqrt(const AutoDiff<N, order, most>& f) {
  const double root = std::sqrt(f.value);
  return compose(f, root, 0.5 / root, -0.25 / (root * f.value));
}
/// f^n. @param f  positive
template <int N, int order, int most>
AutoDiff<N, order, most> pow(const AutoDiff<N, order, most>& f, double n) {
  const double power = std::pow(f.value, n), p1 = n * power / f.value;
  return compose(f, power, p1, (n - 1) * p1 / f.value);
}
/// Returns the angle of sine s and cosine c, up to a common positive factor, in (-pi, pi].
template <int N, int order, int most>
AutoDiff<N, order, most> atan2(const AutoDiff<N, order, most>& s, const AutoDiff<N, order, most>& c) {
  const double w = s.value * s.value + c.value * c.value, s_w = s.value / w, c_w = c.value / w;
  return compose(s, c, std::atan2(s.value, c.value), c_w, -s_w, -2 * s_w * c_w, s_w * s_w - c_w * c_w, 2 * s_w * c_w);
}

}  // namespace bielle
