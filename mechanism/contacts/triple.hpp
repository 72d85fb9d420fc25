// Vectors of numbers, which may carry derivatives: the same code of the geometry computes values, or values with exact
// derivatives.
#pragma once

#include "mechanism/math/types.hpp"
#include "reduce/common/autodiff.hpp"

namespace bielle::mechanism {

using bielle::value_of;

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
