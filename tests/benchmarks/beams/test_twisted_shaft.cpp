// A straight shaft under a twisting moment and a tension buckles into a helix, which hockles.
//
// A. G. Greenhill, Proc. Inst. Mech. Eng. 34 (1883) 182; J. M. T. Thompson, G. H. M. van der Heijden, Proc. R. Soc. A
// 452 (1996) 3153: with w = y + i z and B = EI, B w'''' - i M w''' - T w'' = 0. A shaft with clamped ends that may
// approach each other and turn about its axis satisfies, with m = M L/2B and n^2 = m^2 - T L^2/B,
//     (m^2 - n^2) sin n = 2 n (cos n - cos m);
// without tension tan m = m, M = 8.9868 B/L.
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"

using namespace bielle::mechanism;

namespace {

/// EI = L = 1; shear and stretch are negligible.
StaticsReport twisted(int elements, double moment, double tension, double GJ) {
  const MechanismFile file = read_mechanism_text(
      fmt::format(
          "nodes: {{a: {{position: [0, 0, 0], fixed: true}}, b: {{position: [1, 0, 0], fixed: [y, z, ry, "
          "rz]}}}}\n"
          "elements: {{shaft: {{type: beam, nodes: [a, b], elements: {}, orientation: [0, 1, 0], section: {{EA: "
          "1e8, GAy: 1e8, GAz: 1e8, GJ: {}, EIy: 1, EIz: 1}}}}}}\n"
          "loads: {{twist: {{node: b, moment: [{:.17g}, 0, 0], force: [{:.17g}, 0, 0]}}}}\n",
          elements, GJ, moment, tension),
      "model.yaml");
  Session session(file.model);
  StaticsOptions options;
  options.steps = 10;
  return compute_statics(session, options);
}

/// Returns the smallest factor at which moment and tension make it unstable.
double critical_factor(double moment, double tension) {
  const auto excess = [&](double factor) {
    const double m = factor * moment / 2, square = m * m - factor * tension;
    if (square <= 0) return 1.0;  // it is stable there: the condition has no solution
    const double n = std::sqrt(square);
    return ((m * m - square) * std::sin(n) - 2 * n * (std::cos(n) - std::cos(m))) / n;
  };
  const double sign = excess(1e-3) > 0 ? 1 : -1, step = 1e-3;
  double low = 1e-3, high = low + step;
  while (sign * excess(high) > 0) high = (low = high) + step;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (sign * excess(middle) > 0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

TEST_CASE("a twisted shaft hockles at Greenhill's moment, under tension, without and pressed") {
  struct Case {
    double moment, tension, exact;
  };
  const std::vector<Case> cases = {{12, 0, 8.98681891581813 / 12},
                                   {16, 10, critical_factor(16, 10)},
                                   {20, 30, critical_factor(20, 30)},
                                   {12, -20, critical_factor(12, -20)}};
  for (const Case& each : cases)
    for (const double GJ : {0.8, 50.0}) {  // the angle by which it turns makes no difference, since its section is
                                           // round
      CAPTURE(each.moment, each.tension, GJ);
      std::vector<double> errors;
      for (const int elements : {12, 24, 48}) {
        const StaticsReport report = twisted(elements, each.moment, each.tension, GJ);
        REQUIRE_FALSE(report.log.critical.empty());
        CHECK(report.log.critical[0].before == 0);
        errors.push_back(report.log.critical[0].factor / each.exact - 1);
      }
      CAPTURE(errors);
      // The elements have constant strain: their error is of second order; the error after extrapolation is of fourth
      // order.
      CHECK(std::abs(errors[2]) < 0.3 * std::abs(errors[1]));
      CHECK(std::abs(errors[1]) < 0.3 * std::abs(errors[0]));
      CHECK(std::abs(errors[2] - (errors[1] - errors[2]) / 3) < 1e-3);
    }
}

TEST_CASE("the branch of a shaft that is turned at its end: two motions at once, and as the root of what is too much") {
  // If its end is turned, the shaft hockles at Greenhill's moment, at the angle M L/GJ; if it is stiff in torsion, it
  // stays on the helix. The direction of the deflection is arbitrary, because nothing resists a motion along the circle
  // of these helices.
  struct Turned {
    StaticsReport report;
    double deflection;
  };
  constexpr double GJ = 50;
  const auto turned = [&](int elements, double angle) {
    const MechanismFile file = read_mechanism_text(
        fmt::format(
            "nodes: {{a: {{position: [0, 0, 0], fixed: true}}, b: {{position: [1, 0, 0], fixed: [y, z, ry, rz], "
            "motion: {{rx: {:.17g}}}}}}}\n"
            "elements: {{shaft: {{type: beam, nodes: [a, b], elements: {}, orientation: [0, 1, 0], section: {{EA: "
            "1e8, GAy: 1e8, GAz: 1e8, GJ: {}, EIy: 1, EIz: 1}}}}}}\n",
            angle, elements, GJ),
        "model.yaml");
    Session session(file.model);
    StaticsOptions options;
    options.steps = 4;
    options.branch = 1e-3;
    Turned result;
    result.report = compute_statics(session, options);
    result.deflection = session.node(fmt::format("shaft.{}", elements / 2)).x.tail<2>().norm();
    return result;
  };
  std::vector<double> critical;
  for (const int elements : {12, 24}) {
    const double expected = 8.98681891581813 / GJ;
    const StaticsReport report = turned(elements, 1.2 * expected).report;
    REQUIRE(report.log.critical.size() == 1);
    CHECK(report.log.critical[0].before == 0);
    CHECK(report.log.critical[0].after == 2);
    CHECK(report.log.critical[0].left);
    CHECK(report.log.unstable == 0);
    critical.push_back(1.2 * expected * report.log.critical[0].factor);
  }
  CHECK((4 * critical[1] - critical[0]) / 3 == Approx(8.98681891581813 / GJ).epsilon(1e-3));
  const double near = turned(12, 1.02 * critical[0]).deflection, far = turned(12, 1.04 * critical[0]).deflection;
  CHECK(far * far / (near * near) == Approx(2).epsilon(0.05));
}

TEST_CASE("the closed form has Euler's load of a clamped column for its limit without a moment") {
  // The buckling load is 4 pi^2 EI/L^2 if the ends of the column do not move sideways.
  CHECK(critical_factor(1e-4, -100) * 100 == Approx(4 * std::pow(M_PI, 2)).epsilon(1e-6));
}
