// Coefficients of the exponential and tangent operators against values computed with 250 digits from their closed forms
// (mpmath), over the whole range and on both sides of the angle where the power series begins.
#include <cmath>

#include <catch2/catch.hpp>

#include "mechanism/math/so3.hpp"

using namespace bielle::mechanism;

namespace {

struct Row {
  double phi, a1, a2, a3, c1, c2, b, bp, bpp;
};

const Row rows[] = {
    {1e-12, 1.0, 5.0e-1, 1.66666666666666667e-1, -8.33333333333333333e-2, -1.66666666666666667e-2,
     8.33333333333333333e-2, 2.77777777777777778e-3, 2.6455026455026455e-4},
    {1e-8, 9.99999999999999983e-1, 4.99999999999999996e-1, 1.66666666666666666e-1, -8.33333333333333328e-2,
     -1.66666666666666666e-2, 8.33333333333333335e-2, 2.77777777777777779e-3, 2.64550264550264552e-4},
    {1e-4, 9.99999998333333334e-1, 4.99999999583333333e-1, 1.66666666583333333e-1, -8.33333332777777778e-2,
     -1.66666666587301587e-2, 8.33333333472222222e-2, 2.7777777791005291e-3, 2.64550264748677249e-4},
    {1e-3, 9.99999833333341667e-1, 4.99999958333334722e-1, 1.66666658333333532e-1, -8.33333277777779266e-2,
     -1.66666658730158896e-2, 8.33333347222222553e-2, 2.77777791005291501e-3, 2.64550284391535394e-4},
    {0.1, 9.98334166468281523e-1, 4.9958347219742339e-1, 1.66583353171847693e-1, -8.32777926565257819e-2,
     -1.66587318119689114e-2, 8.33472255299274575e-2, 2.77910102529934205e-3, 2.64748777499400376e-4},
    {0.5, 9.58851077208406001e-1, 4.89669752438509136e-1, 1.64595691166375998e-1, -8.19537106744490821e-2,
     -1.64692842424754316e-2, 8.3682635354059895e-2, 2.81115921108181553e-3, 2.69573879134462296e-4},
    {1, 8.41470984807896507e-1, 4.59697694131860283e-1, 1.58529015192103493e-1, -7.79244034558240585e-2,
     -1.58893514444501974e-2, 8.47561391437740404e-2, 2.91518569123666502e-3, 2.85437557087034904e-4},
    {1.9999, 4.54692253094044663e-1, 3.54049380233869233e-1, 1.36340570442681676e-1, -6.33579624812766723e-2,
     -1.37444571849012961e-2, 8.94761663463797444e-2, 3.39839883722849296e-3, 3.63120522354172011e-4},
    {2.0001, 4.54605173539127648e-1, 3.54024037763398372e-1, 1.36335072767103696e-1, -6.33543898995413451e-2,
     -1.37439207080475723e-2, 8.94775257349649258e-2, 3.39854409029896029e-3, 3.63144830347061318e-4},
    {2.5, 2.39388857641582598e-1, 2.88182978487509394e-1, 1.21697782777346784e-1, -5.39163358933497906e-2,
     -1.23056591751249534e-2, 9.35453165490942865e-2, 3.84897430470499588e-3, 4.41159995128402227e-4},
    {3.14159265358979, 1.03083467542579064e-15, 2.02642367284675961e-1, 1.01321183642337876e-1, -4.10639290187374056e-2,
     -1.02659822546843458e-2, 1.01321183642337723e-1, 4.79833140121576616e-3, 6.21805095353565704e-4},
    {4, -1.89200623826982063e-1, 1.03352726303975745e-1, 7.43250389891863789e-2, -2.4744129777183347e-2,
     -7.47639941647396201e-3, 1.1970719429503572e-1, 7.50971343567023495e-3, 1.24237454778936474e-3},
    {6, -4.65692496998209788e-2, 1.10638092637872165e-3, 2.90713680472172494e-2, -1.35505587646051173e-3,
     -2.39188120042425074e-3, 6.123821570639889e-1, 3.3092450431278934e-1, 3.80176781636592835e-1},
};

}  // namespace

TEST_CASE("the coefficients of finite rotations keep their digits at every angle") {
  static_assert(series_angle == 2.0, "rows must stand on both sides of the series' threshold");
  for (const Row& r : rows) {
    CAPTURE(r.phi);
    const ExpCoefficients e(r.phi * r.phi);
    const InverseCoefficients i(r.phi * r.phi);
    // phi^2 and the argument of sin are rounded: a few epsilon of the largest term.
    const double epsilon = 2.3e-16;
    CHECK_THAT(e.a1, Catch::WithinAbs(r.a1, 4 * epsilon));
    CHECK_THAT(e.a2, Catch::WithinAbs(r.a2, 4 * epsilon * 0.5));
    CHECK_THAT(e.a3, Catch::WithinAbs(r.a3, 4 * epsilon / 6));
    // Differences of the above divided by phi^2 >= 4 beyond the threshold.
    CHECK_THAT(e.c1, Catch::WithinAbs(r.c1, 8 * epsilon / 12));
    CHECK_THAT(e.c2, Catch::WithinAbs(r.c2, 8 * epsilon / 12));
    // b and its derivatives have a pole at 2 pi, where the rounding of phi counts 1/(2 pi - phi) times.
    const double pole = 1 + 1 / (2 * M_PI - r.phi);
    CHECK_THAT(i.b, Catch::WithinRel(r.b, 20 * epsilon * pole));
    // Closed form: terms of size 1 divided by phi^4 (bp ~ 3e-3) and terms of size 10 divided by phi^6 (bpp ~ 4e-4).
    const double x = r.phi * r.phi;
    const double lost_bp = r.phi < series_angle ? 0 : 4 / (x * x * r.bp);
    const double lost_bpp = r.phi < series_angle ? 0 : 20 / (x * x * x * r.bpp);
    CHECK_THAT(i.bp, Catch::WithinRel(r.bp, (20 * pole + lost_bp) * epsilon));
    CHECK_THAT(i.bpp, Catch::WithinRel(r.bpp, (40 * pole + lost_bpp) * epsilon));
    CHECK_THAT(i.bpp, Catch::WithinRel(r.bpp, 1e-13));
  }
}

TEST_CASE("the coefficients at rest are their limits") {
  const ExpCoefficients e(0);
  CHECK(e.a1 == 1);
  CHECK(e.a2 == 0.5);
  CHECK(e.a3 == 1.0 / 6);
  CHECK_THAT(e.c1, Catch::WithinAbs(-1.0 / 12, 1e-17));
  CHECK_THAT(e.c2, Catch::WithinAbs(-1.0 / 60, 1e-17));
  const InverseCoefficients i(0);
  CHECK(i.b == 1.0 / 12);
  CHECK_THAT(i.bp, Catch::WithinRel(2.0 / 720, 1e-15));
  CHECK_THAT(i.bpp, Catch::WithinRel(8.0 / 30240, 1e-15));
}
