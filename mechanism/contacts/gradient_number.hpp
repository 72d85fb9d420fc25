// Numbers with their gradient, and vectors of them: a geometric formula that is written once gives values, or values
// with exact derivatives.
//
// A formula is a template in its number T, either `double` or `GradientNumber<N>`, a value with its derivatives along N
// increments. Branches in a formula depend only on values.
#pragma once

#include <cmath>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

template <int N>
struct GradientNumber {
  using Gradient = Eigen::Matrix<double, N, 1>;
  double value = 0;
  Gradient gradient = Gradient::Zero();
  GradientNumber() = default;
  GradientNumber(double constant) : value(constant) {}  // NOLINT: constants are numbers
  GradientNumber(double v, const Gradient& g) : value(v), gradient(g) {}

  GradientNumber& operator+=(const GradientNumber& b) {
    value += b.value;
    gradient += b.gradient;
    return *this;
  }
  GradientNumber& operator-=(const GradientNumber& b) {
    value -= b.value;
    gradient -= b.gradient;
    return *this;
  }
  GradientNumber& operator*=(const GradientNumber& b) {
    gradient = gradient * b.value + value * b.gradient;
    value *= b.value;
    return *this;
  }
  friend GradientNumber operator+(GradientNumber a, const GradientNumber& b) { return a += b; }
  friend GradientNumber operator-(GradientNumber a, const GradientNumber& b) { return a -= b; }
  friend GradientNumber operator*(GradientNumber a, const GradientNumber& b) { return a *= b; }
  friend GradientNumber operator/(const GradientNumber& a, const GradientNumber& b) {
    const double q = a.value / b.value;
    return {q, (a.gradient - q * b.gradient) / b.value};
  }
  friend GradientNumber operator-(const GradientNumber& a) { return {-a.value, -a.gradient}; }
};

inline double value_of(double a) { return a; }
template <int N>
double value_of(const GradientNumber<N>& a) {
  return a.value;
}

/// The composition p(a). @param p,slope  value and slope of the function at a
inline double composed(double /*a*/, double p, double /*slope*/) { return p; }
template <int N>
GradientNumber<N> composed(const GradientNumber<N>& a, double p, double slope) {
  return {p, slope * a.gradient};
}

/// @param a  must be positive
template <class T>
T root_of(const T& a) {
  const double root = std::sqrt(value_of(a));
  return composed(a, root, 0.5 / root);
}
/// The power a^n. @param a  must be positive
template <class T>
T power_of(const T& a, double n) {
  const double power = std::pow(value_of(a), n);
  return composed(a, power, n * power / value_of(a));
}

template <class T>
struct Triple {
  T x{}, y{}, z{};
  Triple() = default;
  Triple(const T& a, const T& b, const T& c) : x(a), y(b), z(c) {}
  explicit Triple(const Vector3& v) : x(v.x()), y(v.y()), z(v.z()) {}
  friend Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Triple operator-(const Triple& a) { return {-a.x, -a.y, -a.z}; }
  friend Triple operator*(const T& s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }
  Triple& operator+=(const Triple& b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
};

template <class T>
T dot(const Triple<T>& a, const Triple<T>& b) {
  T sum = a.x * b.x;
  sum += a.y * b.y;
  sum += a.z * b.z;
  return sum;
}
template <class T>
Triple<T> cross(const Triple<T>& a, const Triple<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
Vector3 value_of(const Triple<T>& a) {
  return {value_of(a.x), value_of(a.y), value_of(a.z)};
}

}  // namespace bielle::mechanism
