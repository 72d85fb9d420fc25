// Scalars with their first and second derivatives along N increments of the configuration, and the algebra on them.
//
// Along increments dz (of nodes: dx inertial, dTheta in node axes, R exp(dTheta~)),
//     df = g . dz,   dg = S dz,   hence along a motion   fdot = g . v,   fddot = g . a + v . S v.
// S is not symmetric: rotational increments do not commute. The rules of products and compositions nevertheless hold,
//     S(f h) = f S_h + h S_f + g_f g_h^T + g_h g_f^T,    S(p(f)) = p' S_f + p'' g_f g_f^T,
// because each term is linear in the second derivatives, and the added terms are symmetric. A joint is defined by the
// formula of its constraint, in terms of positions along axes, alignments of axes and angles (pair_measure.hpp).
#pragma once

#include <cmath>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

template <int N>
struct MeasureJet {
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;
  double value = 0;
  Vector gradient = Vector::Zero();  ///< gradient g
  Matrix second = Matrix::Zero();    ///< second derivative S
  double rate(const Vector& v) const { return gradient.dot(v); }
  double acceleration(const Vector& v, const Vector& a) const { return gradient.dot(a) + v.dot(second * v); }

  MeasureJet& operator+=(const MeasureJet& other) {
    value += other.value;
    gradient += other.gradient;
    second += other.second;
    return *this;
  }
  MeasureJet& operator-=(const MeasureJet& other) {
    value -= other.value;
    gradient -= other.gradient;
    second -= other.second;
    return *this;
  }
  MeasureJet& operator*=(double factor) {
    value *= factor;
    gradient *= factor;
    second *= factor;
    return *this;
  }
  MeasureJet& operator+=(double constant) {
    value += constant;
    return *this;
  }
};

template <int N>
MeasureJet<N> operator+(MeasureJet<N> a, const MeasureJet<N>& b) {
  return a += b;
}
template <int N>
MeasureJet<N> operator-(MeasureJet<N> a, const MeasureJet<N>& b) {
  return a -= b;
}
template <int N>
MeasureJet<N> operator*(double factor, MeasureJet<N> a) {
  return a *= factor;
}
template <int N>
MeasureJet<N> operator-(MeasureJet<N> a) {
  return a *= -1;
}
template <int N>
MeasureJet<N> operator+(MeasureJet<N> a, double constant) {
  return a += constant;
}
template <int N>
MeasureJet<N> operator-(MeasureJet<N> a, double constant) {
  return a += -constant;
}

/// The composition p(f). @param p,p1,p2  the function and its first two derivatives at f
template <int N>
MeasureJet<N> compose(const MeasureJet<N>& f, double p, double p1, double p2) {
  MeasureJet<N> result;
  result.value = p;
  result.gradient = p1 * f.gradient;
  result.second.noalias() = (p2 * f.gradient) * f.gradient.transpose();
  result.second += p1 * f.second;
  return result;
}

/// The composition p(f, h). @param p_f,..  partial derivatives at (f, h)
template <int N>
MeasureJet<N> compose(const MeasureJet<N>& f, const MeasureJet<N>& h, double p, double p_f, double p_h, double p_ff,
                      double p_fh, double p_hh) {
  MeasureJet<N> result;
  result.value = p;
  result.gradient = p_f * f.gradient + p_h * h.gradient;
  const typename MeasureJet<N>::Vector by_f = p_ff * f.gradient + p_fh * h.gradient,
                                       by_h = p_fh * f.gradient + p_hh * h.gradient;
  result.second.noalias() = by_f * f.gradient.transpose();
  result.second.noalias() += by_h * h.gradient.transpose();
  result.second += p_f * f.second + p_h * h.second;
  return result;
}

template <int N>
MeasureJet<N> operator*(const MeasureJet<N>& a, const MeasureJet<N>& b) {
  return compose(a, b, a.value * b.value, b.value, a.value, 0, 1, 0);
}
/// @param b  must not be zero
template <int N>
MeasureJet<N> operator/(const MeasureJet<N>& a, const MeasureJet<N>& b) {
  const double q = a.value / b.value, i = 1 / b.value;
  return compose(a, b, q, i, -q * i, 0, -i * i, 2 * q * i * i);
}
template <int N>
MeasureJet<N> square(const MeasureJet<N>& f) {
  return compose(f, f.value * f.value, 2 * f.value, 2);
}
/// @param f  must be positive
template <int N>
MeasureJet<N> sqrt(const MeasureJet<N>& f) {
  const double root = std::sqrt(f.value);
  return compose(f, root, 0.5 / root, -0.25 / (root * f.value));
}
/// The angle is in (-pi, pi]. @param s,c  not both zero
template <int N>
MeasureJet<N> atan2(const MeasureJet<N>& s, const MeasureJet<N>& c) {
  const double w = s.value * s.value + c.value * c.value, s_w = s.value / w, c_w = c.value / w;
  return compose(s, c, std::atan2(s.value, c.value), c_w, -s_w, -2 * s_w * c_w, s_w * s_w - c_w * c_w, 2 * s_w * c_w);
}

}  // namespace bielle::mechanism
