// The cantilever under a transverse dead load at its tip.
//
// Inextensible rod (K. Mattiasson, IJNME 17 (1981) 145) and Reissner's rod with EA = 1200 EI/L^2, GA = 5/6 EA/2.6, both
// by shooting (tests/references/elastica.py). x along the beam, y along the load, P L^2/EI = alpha.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/reference_table.hpp"
#include "tests/support/static_model.hpp"

using namespace bielle::mechanism;
using bielle::test::StaticModel;

namespace {

/// Returns the position and slope of the tip, L = EI = 1.
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
  const bielle::test::ReferenceTable table("elastica");
  for (const double alpha : {1, 2, 5, 10}) {
    const std::string row = fmt::format("inextensible_{}.", alpha);
    const Vector3 exact(1 - table(row + "shortening"), table(row + "deflection"), table(row + "slope"));
    // Extension and shear change the tip by about alpha/EA.
    const double EA = 1e6, same = 2 * alpha / EA;
    const std::vector<double> e = errors(exact, alpha, EA, EA, 50);
    CAPTURE(alpha, e);
    CHECK(std::log2(e[0] / e[1]) > 1.9);
    CHECK(e[1] < 2e-4 * alpha);
    CHECK(e[3] < 1e-6 * alpha + same);
  }
}

TEST_CASE("a cantilever that stretches and shears converges with the square of the element length") {
  const bielle::test::ReferenceTable table("elastica");
  for (const double alpha : {1, 10}) {
    const Vector3 exact = table.vector(fmt::format("reissner_{}", alpha));
    const std::vector<double> e = errors(exact, alpha, 1200, 1000 / 2.6, 10);
    CAPTURE(alpha, e);
    for (std::size_t k = 1; k < e.size(); ++k) CHECK(std::log2(e[k - 1] / e[k]) > 1.9);
    CHECK_THAT(std::log2(e[2] / e[3]), Catch::WithinAbs(2, 0.15));  // faster at first: bending is of fourth order
    CHECK(e[3] < 2e-6 * alpha);
  }
}
