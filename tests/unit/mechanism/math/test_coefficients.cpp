// Coefficients of the exponential and tangent operators: against values computed with 250 digits from their closed
// forms (mpmath), and, over the whole range and on both sides of the angle where power series begin, against extended
// precision. The worst errors found are printed with `test_math -s "*worst*"`.
#include <algorithm>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "mechanism/math/rotation_coefficients.hpp"

using namespace bielle::mechanism;

namespace {

constexpr std::size_t count = 10;
const char* const names[count] = {"a1", "a2", "a3", "c1", "c2", "d1", "d2", "b", "bp", "bpp"};

struct Row {
  double phi;
  double value[count];
};

// clang-format off
const Row rows[] = {
    {1e-12, {1.0, 0.5, 0.16666666666666666667, -0.083333333333333333333, -0.016666666666666666667, 0.011111111111111111111, 0.0015873015873015873016, 0.083333333333333333333, 0.0027777777777777777778, 0.00026455026455026455026}},
    {1e-8, {0.99999999999999998333, 0.49999999999999999583, 0.16666666666666666583, -0.083333333333333332778, -0.016666666666666666587, 0.011111111111111111052, 0.001587301587301587295, 0.083333333333333333472, 0.002777777777777777791, 0.00026455026455026455225}},
    {1e-4, {0.99999999833333333417, 0.49999999958333333347, 0.16666666658333333335, -0.083333333277777777793, -0.016666666658730158732, 0.01111111110515873016, 0.0015873015866402116403, 0.083333333347222222226, 0.002777777779100529101, 0.00026455026474867724878}},
    {1e-3, {0.99999983333334166667, 0.49999995833333472222, 0.16666665833333353175, -0.083333327777777926587, -0.01666666587301588955, 0.011111110515873029101, 0.0015873015211640223665, 0.083333334722222255291, 0.0027777779100529150132, 0.00026455028439153539362}},
    {0.1, {0.99833416646828152307, 0.49958347219742339044, 0.16658335317184769319, -0.083277792656525781946, -0.01665873181196891136, 0.011105160052743052618, 0.0015866403318774855729, 0.083347225529927457498, 0.0027791010252993420461, 0.00026474877749940037629}},
    {0.5, {0.95885107720840600055, 0.48966975243850913553, 0.16459569116637599781, -0.081953710674449082093, -0.016469284242475431625, 0.010963125702652762598, 0.0015708421517123041265, 0.083682635354059894959, 0.0028111592110818155277, 0.00026957387913446229571}},
    {1, {0.84147098480789650665, 0.4596976941318602826, 0.15852901519210349335, -0.077924403455824058546, -0.015889351444450197443, 0.010528934883539444931, 0.0015223537664269286715, 0.084756139143774040366, 0.0029151856912366650224, 0.0002854375570870349043}},
    {1.5, {0.66499665773603628729, 0.41300568814768759552, 0.14889037433953942787, -0.071562097137483957217, -0.014962415498191416929, 0.0098369221074611827648, 0.0014444357126547233021, 0.086635728261318658197, 0.0031025561740552819695, 0.00031479240609372067993}},
    {2, {0.4546487134128408477, 0.35403670913678559675, 0.13633782164678978808, -0.06335617621518258645, -0.013744188950895941869, 0.0089314543426836342817, 0.001341192134824280724, 0.089476846016417324248, 0.003398471460732663601, 0.00036313267577332968464}},
    {2.5, {0.23938885764158259762, 0.28818297848750939437, 0.12169778277734678438, -0.05391633589334979058, -0.012305659175124953403, 0.0078688236581178483725, 0.0012179135971639962296, 0.093545316549094286453, 0.0038489743047049958842, 0.00044115999512840222711}},
    {2.9999, {0.04707457135363253048, 0.22112345016761850901, 0.10588766224275961143, -0.043910963902315137511, -0.010727330316841903028, 0.0067124550100314579153, 0.0010807040103881744919, 0.099290608637458510063, 0.0045391785717062615193, 0.00057041321536852860446}},
    {3.0001, {0.047005435853728921234, 0.22109710479749065586, 0.10588122603909281808, -0.043906936571137815787, -0.010726681911486009739, 0.0067119822521869211878, 0.0010806471763533276828, 0.099293332247279924739, 0.0045395208396965103891, 0.00057048008721374196487}},
    {3.14159265358979, {1.0308346754257906395e-15, 0.20264236728467596067, 0.10132118364233787589, -0.041063929018737405632, -0.010265982254684345772, 0.00637660131804930924, 0.0010401614732958532285, 0.10132118364233772263, 0.0047983314012157661565, 0.00062180509535356570395}},
    {3.5, {-0.10022377933989138518, 0.15807809692169766022, 0.089814186068562562055, -0.033990201892513200459, -0.009090976431346124567, 0.0055262772830136900955, 0.00093589226646672835725, 0.10751078914288136054, 0.0056375601961133348656, 0.00079826554686018277621}},
    {4, {-0.18920062382698206284, 0.10335272630397574466, 0.074325038989186378928, -0.024744129777183347011, -0.0074763994164739620074, 0.0043718019871215013941, 0.00078986670657415393913, 0.11970719429503572047, 0.0075097134356702349533, 0.0012423745477893647439}},
    {5, {-0.19178485493262769378, 0.028653512581470949421, 0.047671394197305107751, -0.0099636752038227837049, -0.0045744268004177749533, 0.002354903297245011726, 0.00051633835193064364246, 0.17386481283041513602, 0.01936519560090547138, 0.0052791309482149454406}},
    {6, {-0.046569249699820978802, 0.0011063809263787216515, 0.029071368047217249411, -0.0013550558764605117251, -0.0023918812004242507384, 0.00092736696185223818501, 0.00029456528126835394352, 0.61238215706398890023, 0.33092450431278933992, 0.38017678163659283533}},
    {6.2, {-0.01340151658346719, 0.000089955852673842998455, 0.026363202824752008065, -0.00035331499190465338182, -0.0020551418475957903537, 0.00072025252184434907891, 0.00025812680140671952098, 1.9638243727491724178, 3.7098456800565546512, 14.289076452747449408}},
    {7, {0.093855228388398441485, 0.0050224029725856196298, 0.018492750441053093031, 0.0017104167845556571883, -0.0010297111908280338666, 0.00013527919041316009486, 0.00013997903548358829635, -0.17027872851818430873, 0.044522114478719573905, -0.018521947917776435458}},
};
// clang-format on

void evaluate(double phi_squared, double (&value)[count]) {
  const ExpCoefficients e(phi_squared);
  const ExpSecondCoefficients s(phi_squared);
  const InverseCoefficients i(phi_squared);
  const double all[count] = {e.a1, e.a2, e.a3, e.c1, e.c2, s.d1, s.d2, i.b, i.bp, i.bpp};
  std::copy(all, all + count, value);
}

using Long = long double;

/// sum_k coefficient(k) x^k, from the smallest term.
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

/// Worst relative errors on a fine grid of angles in [from, to], each with its neighbourhood.
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
  for (const Row& row : rows) {
    double value[count];
    evaluate(row.phi * row.phi, value);
    for (std::size_t n = 0; n < count; ++n) {
      CAPTURE(row.phi, names[n]);
      // Rounding of phi^2 counts 1/(2 pi - phi) times at the pole of b, and near the zeros of a1 at pi and of a2, c1
      // at 2 pi, where the terms have the size of their value at rest.
      const double pole = n < 7 ? 1 : 1 + 4 / std::abs(2 * M_PI - row.phi);
      const bool vanishes = (n == 0 && row.phi > 2.9) || ((n == 1 || n == 3 || n == 5) && row.phi > 5);
      const double size = vanishes ? 0.2 : std::abs(row.value[n]);
      CHECK_THAT(value[n], Catch::WithinAbs(row.value[n], 5e-15 * pole * size));
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
