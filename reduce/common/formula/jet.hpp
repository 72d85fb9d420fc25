// Arithmetic with a value and its first two derivatives along one argument, and the same operations for plain numbers,
// so that one template evaluates a formula with either.
//
//     (f g)'' = f'' g + 2 f' g' + f g'',   f(x)'' = f''(x) x'^2 + f'(x) x''
#pragma once

#include <cmath>
#include <stdexcept>
#include <type_traits>

namespace bielle {

/// An operation that is not defined for its arguments, e.g. "division by zero".
class FormulaError : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

/// Value and derivatives along one argument.
struct Jet {
  double value = 0, first = 0, second = 0;
};

namespace jets {

/// a * b, where zero times infinity is zero: a term that does not vary contributes no derivative.
inline double product(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }

/// Sign of x immediately to the right of the point of evaluation.
inline double sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
inline double sign_of(const Jet& x) {
  return x.value != 0 ? sign_of(x.value) : x.first != 0 ? sign_of(x.first) : sign_of(x.second);
}

inline double value_of(double x) { return x; }
inline double value_of(const Jet& x) { return x.value; }

/// Tells whether x is above its value immediately to the right; piecewise functions then take the piece on the right.
inline bool rises(double) { return true; }
inline bool rises(const Jet& x) { return x.first != 0 ? x.first > 0 : x.second >= 0; }

// f(x) by the chain rule, from f, f' and f'' at x.
inline double chain(double, double f, double, double) { return f; }
inline Jet chain(const Jet& x, double f, double f1, double f2) {
  return {f, product(f1, x.first), product(f2, x.first * x.first) + product(f1, x.second)};
}

inline double plus(double a, double b) { return a + b; }
inline Jet plus(const Jet& a, const Jet& b) { return {a.value + b.value, a.first + b.first, a.second + b.second}; }
inline double times(double a, double b) { return a * b; }
inline Jet times(const Jet& a, const Jet& b) {
  return {a.value * b.value, a.first * b.value + a.value * b.first,
          a.second * b.value + 2 * a.first * b.first + a.value * b.second};
}
inline double scale(double factor, double a) { return factor * a; }
inline Jet scale(double factor, const Jet& a) { return {factor * a.value, factor * a.first, factor * a.second}; }
inline double minus(double a, double b) { return a - b; }
inline Jet minus(const Jet& a, const Jet& b) { return {a.value - b.value, a.first - b.first, a.second - b.second}; }

inline bool varies(double) { return false; }
inline bool varies(const Jet& x) { return x.first != 0 || x.second != 0; }

inline double over(double a, double b) {
  if (b == 0) throw FormulaError("division by zero");
  return a / b;
}
inline Jet over(const Jet& a, const Jet& b) {
  const double q = over(a.value, b.value), q1 = (a.first - q * b.first) / b.value;
  return {q, q1, (a.second - 2 * q1 * b.first - q * b.second) / b.value};
}

/// Derivatives of x^n for a constant n; they are zero if the factor n (n - 1) ... is.
template <class Number>
Number power(const Number& x, double n) {
  const double v = value_of(x), f = std::pow(v, n);
  if constexpr (std::is_same_v<Number, double>)
    return f;
  else
    return chain(x, f, product(n, n == 1 ? 1 : std::pow(v, n - 1)),
                 product(n * (n - 1), n == 2 ? 1 : std::pow(v, n - 2)));
}

/// floor of the value immediately to the right of x
template <class Number>
double floor_of(const Number& x) {
  const double v = std::floor(value_of(x));
  return v == value_of(x) && !rises(x) ? v - 1 : v;
}

}  // namespace jets

}  // namespace bielle
