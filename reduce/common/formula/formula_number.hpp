// The numbers with which formulas are evaluated: plain ones, `Jet` (value and two derivatives along one argument) and
// `Slopes` (value and first derivatives along several arguments together). Two rules hold for formulas: at a border
// between two pieces the piece on the right of the argument counts, and a constant contributes no derivative, however
// steep a function is.
#pragma once

#include <cmath>
#include <stdexcept>

#include "reduce/common/autodiff.hpp"

namespace bielle {

/// Thrown if a formula has no value at its arguments: "division by zero".
class FormulaError : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

using Jet = AutoDiff<1, 2>;
/// At a border the second derivatives are needed (the sign of zero): such points are left to jets.
using Slopes = AutoDiff<Eigen::Dynamic, 1, 16>;

namespace formula_number {

inline Jet jet(double value, double first, double second) {
  Jet x(value);
  x.gradient[0] = first;
  x.second(0, 0) = second;
  return x;
}
inline double first(const Jet& x) { return x.gradient[0]; }
inline double second(const Jet& x) { return x.second(0, 0); }

/// Argument number `index` among `count`.
inline Slopes argument_with_slopes(double value, std::size_t index, std::size_t count) {
  Slopes x(value);
  x.gradient = Slopes::Gradient::Unit(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(index));
  return x;
}

/// Returns the product a b, which is zero if one factor is zero and the other infinite.
inline double product(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }

/// Sign of x on the right of the point of evaluation.
inline double sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
inline double sign_of(const Jet& x) {
  return x.value != 0 ? sign_of(x.value) : first(x) != 0 ? sign_of(first(x)) : sign_of(second(x));
}

/// Returns whether x moves to the right of its value: a piecewise function then takes the piece on the right.
inline bool rises(double) { return true; }
inline bool rises(const Jet& x) { return first(x) != 0 ? first(x) > 0 : second(x) >= 0; }

inline bool varies(double) { return false; }
inline bool varies(const Jet& x) { return first(x) != 0 || second(x) != 0; }
inline bool varies(const Slopes& x) { return x.gradient.size() > 0; }

/// f(x) by the chain rule. @param f,f1,f2  value and derivatives at x
inline double chain(double, double f, double, double) { return f; }
inline Jet chain(const Jet& x, double f, double f1, double f2) {
  return jet(f, product(f1, first(x)), product(f2, first(x) * first(x)) + product(f1, second(x)));
}
inline Slopes chain(const Slopes& x, double f, double f1, double /*f2*/) { return compose(x, f, f1); }

/// @throws FormulaError of a division by zero
template <class Number>
Number over(const Number& a, const Number& b) {
  if (value_of(b) == 0) throw FormulaError("division by zero");
  return a / b;
}

/// x^n for a constant n; derivatives are zero if one of the factors n (n - 1) .. is.
template <class Number>
Number power(const Number& x, double n) {
  const double v = value_of(x);
  return chain(x, std::pow(v, n), n == 2 ? 2 * v : product(n, n == 1 ? 1 : std::pow(v, n - 1)),
               product(n * (n - 1), n == 2 ? 1 : std::pow(v, n - 2)));
}
inline double power(double x, double n) { return std::pow(x, n); }

/// Returns the floor of the value on the right of x.
template <class Number>
double floor_of(const Number& x) {
  const double v = std::floor(value_of(x));
  return v == value_of(x) && !rises(x) ? v - 1 : v;
}

}  // namespace formula_number

}  // namespace bielle
