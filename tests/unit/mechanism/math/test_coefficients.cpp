// Coefficients of the exponential and tangent operators: against values computed with 250 digits from their closed
// forms (tests/references/rotation_coefficients.py), and, over the whole range and on both sides of the angle where
// power series begin, against extended precision. The worst errors found are printed with `test_math -s "*worst*"`.
#include <algorithm>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "mechanism/math/rotation_coefficients.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle::mechanism;

namespace {

constexpr std::size_t count = 10;
const char* const names[count] = {"a1", "a2", "a3", "c1", "c2", "d1", "d2", "b", "bp", "bpp"};

const char* const angles_of_table[] = {
    "1e-12", "1e-8", "1e-4", "1e-3", "0.1", "0.5", "1", "1.5", "2", "2.5", "2.9999", "3.0001", "3.14159265358979",
    "3.5",   "4",    "5",    "6",    "6.2", "7"};

void evaluate(double phi_squared, double (&value)[count]) {
  const ExpCoefficients e(phi_squared);
  const ExpSecondCoefficients s(phi_squared);
  const InverseCoefficients i(phi_squared);
  const double all[count] = {e.a1, e.a2, e.a3, e.c1, e.c2, s.d1, s.d2, i.b, i.bp, i.bpp};
  std::copy(all, all + count, value);
}

using Long = long double;

/// Returns sum_k coefficient(k) x^k, from the smallest term.
template <class Coefficient>
Long power_series(Long x, int terms, const Coefficient& coefficient) {
  Long sum = 0;
  for (int k = terms - 1; k >= 0; --k) sum = sum * x + coefficient(k);
  return sum;
}

Long inverse_factorial(int n) { return n < 2 ? 1 : inverse_factorial(n - 1) / n; }

/// In extended precision, by other means than the code: Maclaurin series up to 2 (1.5 for b: |B_2k|/(2k)! by the
/// recurrence of the cotangent), closed forms beyond.
void reference(Long x, Long (&value)[count]) {
  const Long phi = std::sqrt(x);
  Long a[3], d[4];
  if (phi < 2) {
    const int terms = 25;
    const auto sign = [](int k) { return Long(k % 2 ? -1 : 1); };
    for (int n = 0; n < 3; ++n)
      a[n] = power_series(x, terms, [&](int k) { return sign(k) * inverse_factorial(2 * k + n + 1); });
    for (int n = 0; n < 2; ++n) {
      const auto c = [&](int k) {  // coefficient of x^k of c1, c2 = 2 (k + 1) times that of x^(k+1) of a2, a3
        return 2 * (k + 1) * sign(k + 1) * inverse_factorial(2 * k + n + 4);
      };
      d[n] = power_series(x, terms, c);
      d[2 + n] = power_series(x, terms, [&](int k) { return 2 * (k + 1) * c(k + 1); });
    }
  } else {
    a[0] = std::sin(phi) / phi;
    a[1] = 2 * std::sin(phi / 2) * std::sin(phi / 2) / x;
    a[2] = (phi - std::sin(phi)) / (phi * x);
    d[0] = (a[0] - 2 * a[1]) / x;
    d[1] = (a[1] - 3 * a[2]) / x;
    d[2] = (a[2] - a[1] - 4 * d[0]) / x;
    d[3] = (d[0] - 5 * d[1]) / x;
  }
  Long i[3];
  if (phi < 1.5) {
    constexpr int terms = 30;
    Long beta[terms] = {Long(1) / 12};
    for (int k = 1; k < terms; ++k) {
      for (int j = 0; j < k; ++j) beta[k] += beta[j] * beta[k - 1 - j];
      beta[k] /= 2 * k + 3;
    }
    i[0] = power_series(x, terms, [&](int k) { return beta[k]; });
    i[1] = power_series(x, terms - 1, [&](int k) { return 2 * (k + 1) * beta[k + 1]; });
    i[2] = power_series(x, terms - 2, [&](int k) { return 4 * (k + 1) * (k + 2) * beta[k + 2]; });
  } else {
    const Long half = phi / 2, g = half / std::tan(half), ratio = half / std::sin(half), q = ratio * ratio;
    i[0] = (1 - g) / x;
    i[1] = ((q - g) / x - 2 * i[0]) / x;
    i[2] = ((2 * q * (1 - g) + g - q) - 4 * (q + g - 2)) / (x * x * x);
  }
  const Long all[count] = {a[0], a[1], a[2], d[0], d[1], d[2], d[3], i[0], i[1], i[2]};
  std::copy(all, all + count, value);
}

struct Worst {
  double error[count] = {}, phi[count] = {};
};

/// Returns the worst relative errors on a fine grid of angles in [from, to], each with its neighbourhood.
Worst scan(double from, double to, int points) {
  Worst worst;
  for (int k = 0; k <= points; ++k) {
    const double phi = from + (to - from) * k / points, x = phi * phi;
    double value[count];
    Long exact[count];
    evaluate(x, value);
    reference(x, exact);
    for (std::size_t n = 0; n < count; ++n) {
      const Long size = n == 0 ? 1 : std::abs(exact[n]);  // a1 = 1 at rest, 0 at pi: relative to 1
      const auto error = static_cast<double>(std::abs(value[n] - exact[n]) / size);
      if (error > worst.error[n]) worst.error[n] = error, worst.phi[n] = phi;
    }
  }
  return worst;
}

void report(const Worst& worst) {
  for (std::size_t n = 0; n < count; ++n) {
    INFO(names[n] << ": " << worst.error[n] << " at " << worst.phi[n]);
    SUCCEED();
  }
}

}  // namespace

TEST_CASE("the coefficients of finite rotations have the digits of their closed forms at every angle") {
  const bielle::test::ReferenceTable exact("rotation_coefficients");
  for (const std::string angle : angles_of_table) {
    const double phi = std::stod(angle);
    double value[count];
    evaluate(phi * phi, value);
    for (std::size_t n = 0; n < count; ++n) {
      CAPTURE(angle, names[n]);
      const double expected = exact(angle + "." + names[n]);
      // Rounding of phi^2 counts 1/(2 pi - phi) times at the pole of b, and near the zeros of a1 at pi and of a2, c1
      // at 2 pi, where the terms have the size of their value at rest.
      const double pole = n < 7 ? 1 : 1 + 4 / std::abs(2 * M_PI - phi);
      const bool vanishes = (n == 0 && phi > 2.9) || ((n == 1 || n == 3 || n == 5) && phi > 5);
      const double size = vanishes ? 0.2 : std::abs(expected);
      CHECK_THAT(value[n], Catch::WithinAbs(expected, 5e-15 * pole * size));
    }
  }
}

TEST_CASE("worst relative errors of the coefficients up to half a turn, and across the series' threshold") {
  for (const Worst& worst :
       {scan(1e-9, 1e-2, 2000), scan(1e-2, 3.14, 20000), scan(series_angle - 1e-9, series_angle + 1e-9, 2000),
        scan(1.9999, 2.0001, 200), scan(1.4999, 1.5001, 200)}) {
    report(worst);
    for (std::size_t n = 0; n < count; ++n) {
      CAPTURE(names[n], worst.phi[n]);
      CHECK(worst.error[n] < 1e-14);
    }
  }
}

TEST_CASE("worst relative errors of the coefficients beyond half a turn") {
  const Worst worst = scan(3.2, 5.5, 20000);
  report(worst);
  for (std::size_t n = 0; n < count; ++n) {
    CAPTURE(names[n], worst.phi[n]);
    CHECK(worst.error[n] < 1e-14);
  }
}

TEST_CASE("the coefficients at rest are their limits") {
  const ExpCoefficients e(0);
  CHECK(e.a1 == 1);
  CHECK(e.a2 == 0.5);
  CHECK(e.a3 == 1.0 / 6);
  CHECK_THAT(e.c1, Catch::WithinAbs(-1.0 / 12, 1e-17));
  CHECK_THAT(e.c2, Catch::WithinAbs(-1.0 / 60, 1e-17));
  const ExpSecondCoefficients s(0);
  CHECK_THAT(s.d1, Catch::WithinRel(1.0 / 90, 1e-15));
  CHECK_THAT(s.d2, Catch::WithinRel(1.0 / 630, 1e-15));
  const InverseCoefficients i(0);
  CHECK_THAT(i.b, Catch::WithinRel(1.0 / 12, 1e-15));
  CHECK_THAT(i.bp, Catch::WithinRel(2.0 / 720, 1e-15));
  CHECK_THAT(i.bpp, Catch::WithinRel(8.0 / 30240, 1e-15));
}
