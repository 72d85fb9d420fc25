// Buckling of right-angle frames out of their plane.
//
// J. Argyris et al., Comput. Methods Appl. Mech. Eng. 17/18 (1979) 1: two legs of 240, section 30 x 0.6 in the plane, E
// = 71240, nu = 0.31; published 1.088, 0.680 and 622.2 with GJ = G h b^3/3. References: critical loads of the
// geometrically exact rod by shooting, with the bending before buckling, for that constant and Saint-Venant's
// (tests/references/buckling.py).
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/beams/critical_load.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/static_model.hpp"

using bielle::test::check_load;
using bielle::test::StaticModel;

namespace {

constexpr const char* saint_venant = "{rectangle: [0.6, 30], young: 71240, poisson: 0.31}";
constexpr const char* thin =
    "{EA: 71240*18, GAy: 71240*15/2.62, GAz: 71240*15/2.62, GJ: 71240*30*0.6^3/3/2.62, EIy: 71240*0.6*30^3/12, EIz: "
    "71240*30*0.6^3/12}";

/// Returns the name of a section in the table of references.
std::string name_of(const char* section) { return section == thin ? "thin" : "saint_venant"; }

std::string leg(const std::string& ends, int elements, const std::string& section) {
  return fmt::format("{{type: beam, nodes: {}, elements: {}, orientation: [0, 0, 1], section: {}}}\n", ends, elements,
                     section);
}

/// The frame is clamped at the root; a force in its plane acts at the tip.
double cantilever_load(int elements, const std::string& section, int x, int y, double begin, double step,
                       double tolerance) {
  StaticModel frame(
      "nodes: {root: {position: [0, 0, 0], fixed: true}, corner: {position: [0, 240, 0]}, tip: {position: [240, 240, "
      "0]}}\nelements:\n  first: " +
      leg("[root, corner]", elements, section) + "  second: " + leg("[corner, tip]", elements, section) +
      fmt::format("loads: {{p: {{node: tip, force: [{}, {}, 0]}}}}\n", x, y));
  return frame.critical_load(begin, step, 1e-6, tolerance);
}

/// End moments of either sign act; the ends slide along x and turn about z.
double hinged_load(int elements, const std::string& section, int sign) {
  StaticModel frame(
      "nodes:\n  left: {position: ['-120*sqrt(2)', 0, 0], fixed: [y, z, rx, ry]}\n"
      "  apex: {position: [0, '120*sqrt(2)', 0], fixed: [x]}\n"  // one point of the sliding body is fixed
      "  right: {position: ['120*sqrt(2)', 0, 0], fixed: [y, z, rx, ry]}\nelements:\n  first: " +
      leg("[left, apex]", elements, section) + "  second: " + leg("[apex, right]", elements, section) +
      fmt::format("loads: {{a: {{node: left, moment: [0, 0, {}]}}, b: {{node: right, moment: [0, 0, {}]}}}}\n", sign,
                  -sign));
  return frame.critical_load(600, 5, 1e-5, 1e-4);
}

}  // namespace

TEST_CASE("a cantilever right-angle frame buckles out of its plane") {
  // The load at the tip is parallel to the first leg: away from the clamp, and towards it.
  const bielle::test::ReferenceTable exact("buckling");
  for (const char* section : {saint_venant, thin})
    for (const int direction : {1, -1})
      check_load(exact(name_of(section) + (direction == 1 ? ".away" : ".towards")),
                 [&](int elements) { return cantilever_load(elements, section, 0, direction, 0.5, 0.05, 1e-8); });
}

TEST_CASE("a cantilever right-angle frame under a load along its second leg") {
  // The force acts towards the corner or away from it.
  const bielle::test::ReferenceTable table("buckling");
  for (const int direction : {-1, 1}) {
    const double exact = table(direction == -1 ? "thin.second_towards" : "thin.second_away");
    const auto load = [direction](int elements) {
      return cantilever_load(elements, thin, direction, 0, 0.3, 0.1, 1e-6);
    };
    CHECK_THAT((4 * load(16) - load(8)) / 3, Catch::WithinRel(exact, 2e-4));
  }
}

TEST_CASE("a hinged right-angle frame buckles under end moments of either sign") {
  const bielle::test::ReferenceTable exact("buckling");
  for (const char* section : {saint_venant, thin})
    for (const int sign : {1, -1})
      check_load(exact(name_of(section) + (sign == 1 ? ".opening" : ".closing")),
                 [&](int elements) { return hinged_load(elements, section, sign); });
}
