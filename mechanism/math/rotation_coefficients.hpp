// The scalar functions of the rotation angle phi in the exponential, the tangent operators and their derivatives, each
// to a few roundings at every angle.
//
//   a1 = sin(phi)/phi, a2 = (1 - cos phi)/phi^2, a3 = (phi - sin phi)/phi^3,
//   c1 = a2'/phi = (a1 - 2 a2)/phi^2,   c2 = a3'/phi = (a2 - 3 a3)/phi^2,
//   d1 = c1'/phi = (a3 - a2 - 4 c1)/phi^2,   d2 = c2'/phi = (c1 - 5 c2)/phi^2,
//   b = (1 - (phi/2) cot(phi/2))/phi^2,   bp = b'/phi,   bpp = bp'/phi.
//
// The closed forms of the first seven functions lose digits at small angles: power series in phi^2 are summed below
// `series_angle`. b is split into the terms of its nearest poles and a remainder whose series converges beyond the
// first pole,
//   b = sum_{k>=1} 2/(4 pi^2 k^2 - phi^2) = 2/(4 pi^2 - phi^2) + 2/(16 pi^2 - phi^2) + sum_j beta_j phi^2j,
//   beta_j = 2 sum_{k>=3} (2 pi k)^(-2j-2),
// all terms have the same sign up to 2 pi: no threshold is necessary, and no digits are lost.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace bielle::mechanism {

/// Angle [rad] below which a1 ... d2 are summed as power series. It was chosen by measured error: at this angle the
/// closed form that loses most (d2) is accurate to 7e-15, all others to 1e-15, and the series to 4e-16.
inline constexpr double series_angle = 3.0;

/// Angle [rad] below which the first seven terms of a1 ... c2 are sufficient: the eighth is less than 1e-16 of the
/// first. Rotations within a time step are usually smaller.
inline constexpr double short_series_angle = 0.5;

/// Angle [rad] below which four terms are sufficient: the fifth is less than 2e-16 of the first.
inline constexpr double shortest_series_angle = 0.05;

namespace coefficient_series {

/// Returns sum_k c_k x^k, the sum over the first `terms` terms.
template <std::size_t terms, std::size_t N>
constexpr double horner_of_first(const std::array<double, N>& c, double x) {
  double sum = c[terms - 1];
  for (std::size_t k = terms - 1; k-- > 0;) sum = sum * x + c[k];
  return sum;
}
template <std::size_t N>
constexpr double horner(const std::array<double, N>& c, double x) {
  return horner_of_first<N>(c, x);
}

constexpr double factorial(int n) {
  double f = 1;
  for (int k = 2; k <= n; ++k) f *= k;
  return f;
}

inline constexpr std::size_t exp_terms = 14;
using ExpSeries = std::array<double, exp_terms>;

/// (-1)^k / (2k + offset)!
constexpr ExpSeries exp_series(int offset) {
  ExpSeries c{};
  for (std::size_t k = 0; k < exp_terms; ++k) c[k] = (k % 2 ? -1.0 : 1.0) / factorial(2 * static_cast<int>(k) + offset);
  return c;
}

/// c1 (p = 1, w = 2) and c2 (p = 2, w = 3): sum_{k>=1} (-1)^k phi^(2k-2) (1/(2k+p)! - w/(2k+p+1)!)
constexpr ExpSeries difference_series(int p, double w) {
  ExpSeries c{};
  for (std::size_t i = 0; i < exp_terms; ++i) {
    const int n = 2 * static_cast<int>(i + 1) + p;
    c[i] = (i % 2 ? 1.0 : -1.0) * (1 / factorial(n) - w / factorial(n + 1));
  }
  return c;
}

/// Computes the coefficients of f'/phi from those of f, both in powers of phi^2.
template <std::size_t N>
constexpr std::array<double, N - 1> derivative_series(const std::array<double, N>& f) {
  std::array<double, N - 1> d{};
  for (std::size_t k = 1; k < N; ++k) d[k - 1] = 2.0 * static_cast<double>(k) * f[k];
  return d;
}

inline constexpr std::size_t inverse_terms = 18;

/// Returns the coefficients beta_j; the tail of the sum over k is computed by the Euler-Maclaurin formula.
constexpr std::array<double, inverse_terms> beta_series() {
  std::array<double, inverse_terms> beta{};
  const double first = 3, last = 200;
  double pi_power = 1;  // (2 pi)^-(2j + 2)
  for (std::size_t j = 0; j < inverse_terms; ++j) {
    const int s = 2 * static_cast<int>(j) + 2;
    pi_power /= 4 * std::numbers::pi * std::numbers::pi;
    const auto term = [s](double k) {
      double power = 1;
      for (int n = 0; n < s; ++n) power /= k;
      return power;
    };
    const double f = term(last);
    double sum =
        last * f / (s - 1) + f / 2 + s * f / last / 12 - s * (s + 1) * (s + 2) * f / (last * last * last) / 720;
    for (double k = last - 1; k >= first; --k) sum += term(k);
    beta[j] = 2 * pi_power * sum;
  }
  return beta;
}

inline constexpr auto a1 = exp_series(1), a2 = exp_series(2), a3 = exp_series(3);
inline constexpr auto c1 = difference_series(1, 2), c2 = difference_series(2, 3);
inline constexpr auto d1 = derivative_series(c1), d2 = derivative_series(c2);
inline constexpr auto b = beta_series();
inline constexpr auto bp = derivative_series(b);
inline constexpr auto bpp = derivative_series(bp);

inline constexpr double pole1 = 4 * std::numbers::pi * std::numbers::pi;  ///< phi^2 at 2 pi
inline constexpr double pole2 = 4 * pole1;                                ///< phi^2 at 4 pi

}  // namespace coefficient_series

/// Coefficients of the exponential, of T and of its first derivative, as functions of phi^2.
struct ExpCoefficients {
  double a1, a2, a3, c1, c2;

  explicit ExpCoefficients(double phi_squared) {
    namespace series = coefficient_series;
    const double x = phi_squared;
    if (x < shortest_series_angle * shortest_series_angle) {
      sum_series<4>(x);
      return;
    }
    if (x < short_series_angle * short_series_angle) {
      sum_series<7>(x);
      return;
    }
    if (x < series_angle * series_angle) {
      sum_series<series::exp_terms>(x);
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

 private:
  template <std::size_t terms>
  void sum_series(double x) {
    namespace series = coefficient_series;
    a1 = series::horner_of_first<terms>(series::a1, x);
    a2 = series::horner_of_first<terms>(series::a2, x);
    a3 = series::horner_of_first<terms>(series::a3, x);
    c1 = series::horner_of_first<terms>(series::c1, x);
    c2 = series::horner_of_first<terms>(series::c2, x);
  }
};

/// Coefficients of the second derivative of T, as functions of phi^2.
struct ExpSecondCoefficients {
  double d1, d2;

  explicit ExpSecondCoefficients(double phi_squared) {
    namespace series = coefficient_series;
    const double x = phi_squared;
    if (x < series_angle * series_angle) {
      d1 = series::horner(series::d1, x);
      d2 = series::horner(series::d2, x);
      return;
    }
    const ExpCoefficients e(x);
    d1 = (e.a3 - e.a2 - 4 * e.c1) / x;
    d2 = (e.c1 - 5 * e.c2) / x;
  }
};

/// Coefficients of T^-1 and its derivatives, as functions of phi^2; infinite at phi = 2 pi.
struct InverseCoefficients {
  double b, bp, bpp;

  explicit InverseCoefficients(double phi_squared) {
    namespace series = coefficient_series;
    const double x = phi_squared;
    if (x < short_series_angle * short_series_angle) {
      sum_poles_and_series<5>(x);  // a term is less than 3e-3 of the one before
      return;
    }
    if (x < series::pole1 * 1.01) {
      sum_poles_and_series<series::bpp.size()>(x);
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

 private:
  template <std::size_t terms>
  void sum_poles_and_series(double x) {
    namespace series = coefficient_series;
    const double p1 = 1 / (series::pole1 - x), p2 = 1 / (series::pole2 - x);
    b = 2 * p1 + 2 * p2 + series::horner_of_first<terms>(series::b, x);
    bp = 4 * p1 * p1 + 4 * p2 * p2 + series::horner_of_first<terms>(series::bp, x);
    bpp = 16 * p1 * p1 * p1 + 16 * p2 * p2 * p2 + series::horner_of_first<terms>(series::bpp, x);
  }
};

}  // namespace bielle::mechanism
