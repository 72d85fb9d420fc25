// Arithmetic with a value and its first derivatives along several arguments together:
//
//     d f(a, b) = f_a da + f_b db
//
// It replaces a Jet where second derivatives are not needed. Decisions at a border (the sign of zero) need second
// derivatives and are made with jets.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "reduce/common/formula/jet.hpp"

namespace bielle {

/// Value and slopes along at most `capacity` arguments. Only the first `count` slopes are ever touched.
struct Dual {
  static constexpr std::size_t capacity = 16;

  explicit Dual(double constant) : value(constant) {}
  Dual(double result, std::size_t slopes) : value(result), count(slopes) {}
  Dual(const Dual& other) : value(other.value), count(other.count) {
    for (std::size_t i = 0; i < count; ++i) slope[i] = other.slope[i];
  }
  Dual& operator=(const Dual&) = delete;
  ~Dual() = default;

  double value;
  std::size_t count = 0;               ///< 0 for a constant: all of its derivatives are zero
  std::array<double, capacity> slope;  ///< not initialised
};

namespace jets {

inline double value_of(const Dual& x) { return x.value; }
inline bool varies(const Dual& x) { return x.count != 0; }

/// The argument number `index` among `count`.
inline Dual argument_of_dual(double value, std::size_t index, std::size_t count) {
  Dual x(value, count);
  for (std::size_t i = 0; i < count; ++i) x.slope[i] = i == index ? 1 : 0;
  return x;
}

/// A value f(x) with df = f1 dx.
inline Dual chain(const Dual& x, double f, double f1, double = 0) {
  Dual result(f, x.count);
  for (std::size_t i = 0; i < x.count; ++i) result.slope[i] = f1 * x.slope[i];
  return result;
}

/// A value f(a, b) with df = f_a da + f_b db.
inline Dual chain(double f, const Dual& a, double f_a, const Dual& b, double f_b) {
  if (!varies(b)) return chain(a, f, f_a);
  if (!varies(a)) return chain(b, f, f_b);
  Dual result(f, a.count);
  for (std::size_t i = 0; i < a.count; ++i) result.slope[i] = f_a * a.slope[i] + f_b * b.slope[i];
  return result;
}

inline Dual plus(const Dual& a, const Dual& b) { return chain(a.value + b.value, a, 1, b, 1); }
inline Dual minus(const Dual& a, const Dual& b) { return chain(a.value - b.value, a, 1, b, -1); }
inline Dual times(const Dual& a, const Dual& b) { return chain(a.value * b.value, a, b.value, b, a.value); }
inline Dual scale(double factor, const Dual& a) { return chain(a, factor * a.value, factor); }
inline Dual over(const Dual& a, const Dual& b) {
  const double q = over(a.value, b.value), inverse = 1 / b.value;
  return chain(q, a, inverse, b, -q * inverse);
}
inline Dual power(const Dual& x, double n) {
  const double v = x.value, f = std::pow(v, n);
  return chain(x, f, n == 2 ? 2 * v : product(n, n == 1 ? 1 : std::pow(v, n - 1)));
}

}  // namespace jets

}  // namespace bielle
