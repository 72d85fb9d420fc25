// The cantilever under a transverse dead load at its tip.
//
// Inextensible rod (K. Mattiasson, IJNME 17 (1981) 145) and Reissner's rod with EA = 1200 EI/L^2, GA = 5/6 EA/2.6, both
// by shooting to 1e-12. x along the beam, y along the load, P L^2/EI = alpha.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/static_model.hpp"

using namespace bielle::mechanism;
using bielle::test::StaticModel;

namespace {

/// Position and slope of the tip, L = EI = 1.
Vector3 tip(double alpha, double EA, double GA, int elements, int steps) {
  StaticModel beam(
      fmt::format("nodes: {{root: {{position: [0, 0, 0], fixed: true}}, tip: {{position: [1, 0, 0]}}}}\n"
                  "elements: {{b: {{type: beam, nodes: [root, tip], elements: {}, section: {{EA: {}, GAy: {}, GAz: 1, "
                  "GJ: 1, EIy: 1, "
                  "EIz: 1}}}}}}\nloads: {{p: {{node: tip, force: [0, {}, 0]}}}}\n",
                  elements, EA, GA, alpha));
  REQUIRE(beam.load(steps, 2e-15 * EA * elements) >= 0);
  return {beam.node("tip").x.x(), beam.node("tip").x.y(), log_so3(beam.node("tip").R).z()};
}

std::vector<double> errors(const Vector3& exact, double alpha, double EA, double GA, int steps) {
  std::vector<double> list;
  for (int elements : {4, 8, 16, 32}) list.push_back((tip(alpha, EA, GA, elements, steps) - exact).norm());
  return list;
}

}  // namespace

TEST_CASE("the elastica of an inextensible cantilever") {
  struct Row {
    double alpha, shortening, deflection, slope;
  };
  for (const Row& row :
       {Row{1, 0.056433236283, 0.301720773800, 0.461351949712}, Row{2, 0.160641720825, 0.493457480397, 0.781749831557},
        Row{5, 0.387628360724, 0.713791523612, 1.215368117612},
        Row{10, 0.554995597754, 0.810609024880, 1.430285538804}}) {
    // Extension and shear change the tip by some alpha/EA.
    const double EA = 1e6, same = 2 * row.alpha / EA;
    const std::vector<double> e = errors({1 - row.shortening, row.deflection, row.slope}, row.alpha, EA, EA, 50);
    CAPTURE(row.alpha, e);
    CHECK(std::log2(e[0] / e[1]) > 1.9);
    CHECK(e[1] < 2e-4 * row.alpha);
    CHECK(e[3] < 1e-6 * row.alpha + same);
  }
}

TEST_CASE("a cantilever that stretches and shears converges with the square of the element length") {
  for (const auto& [alpha, exact] : {std::pair{1.0, Vector3(0.943133684318, 0.303973057238, 0.461091000985)},
                                     {10.0, Vector3(0.442940887302, 0.822511585892, 1.426687657757)}}) {
    const std::vector<double> e = errors(exact, alpha, 1200, 1000 / 2.6, 10);
    CAPTURE(alpha, e);
    for (std::size_t k = 1; k < e.size(); ++k) CHECK(std::log2(e[k - 1] / e[k]) > 1.9);
    CHECK_THAT(std::log2(e[2] / e[3]), Catch::WithinAbs(2, 0.15));  // faster at first: bending is of fourth order
    CHECK(e[3] < 2e-6 * alpha);
  }
}
