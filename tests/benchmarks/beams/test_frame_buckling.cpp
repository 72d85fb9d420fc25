// Buckling of right-angle frames out of their plane with the torsion constant of the publication.
//
// J. Argyris et al., Comput. Methods Appl. Mech. Eng. 17/18 (1979) 1: two legs of 240, section 30 x 0.6 in the plane, E
// = 71240, nu = 0.31, GJ = G h b^3/3; published 1.088, 0.680 and 622.2. References: critical loads of the geometrically
// exact rod by shooting (1e-8), with the bending before buckling. (With Saint-Venant's constant:
// test_lateral_buckling.cpp.)
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/static_model.hpp"

using bielle::test::StaticModel;

namespace {

std::string leg(const std::string& name, const std::string& from, const std::string& to, int elements) {
  return fmt::format(
      "  {}: {{type: beam, nodes: [{}, {}], elements: {}, orientation: [0, 0, 1], section: {{EA: 71240*18, GAy: "
      "71240*15/2.62, GAz: 71240*15/2.62, GJ: 71240*30*0.6^3/3/2.62, EIy: 71240*0.6*30^3/12, EIz: "
      "71240*30*0.6^3/12}}}}\n",
      name, from, to, elements);
}

/// Loads for three meshes approach the reference with the square of the element length.
template <class Load>
void check_load(double exact, const Load& load) {
  std::vector<double> errors;
  for (const int elements : {4, 8, 16}) errors.push_back(load(elements) / exact - 1);
  CAPTURE(exact, errors);
  CHECK_THAT(std::log2(errors[1] / errors[2]), Catch::WithinAbs(2, 0.1));
  CHECK(std::abs(4 * errors[2] - errors[1]) / 3 < 1e-4);
}

}  // namespace

TEST_CASE("a cantilever right-angle frame with the published torsion constant") {
  // The load at the tip is parallel to the first leg: away from the clamp, and towards it.
  for (const auto& [direction, exact] : {std::pair{1, 1.0875178408}, {-1, 0.6804273623}})
    check_load(exact, [direction = direction](int elements) {
      StaticModel frame(
          "nodes: {root: {position: [0, 0, 0], fixed: true}, corner: {position: [0, 240, 0]}, tip: {position: [240, "
          "240, 0]}}\nelements:\n" +
          leg("first", "root", "corner", elements) + leg("second", "corner", "tip", elements) +
          fmt::format("loads: {{p: {{node: tip, force: [0, {}, 0]}}}}\n", direction));
      return frame.critical_load(0.5, 0.05, 1e-6, 1e-8);
    });
}

TEST_CASE("a hinged right-angle frame with the published torsion constant") {
  // End moments of either sign; the ends slide along x and turn about z.
  for (const int sign : {1, -1})
    check_load(622.2217, [sign](int elements) {
      StaticModel frame(fmt::format(
          "nodes:\n  left: {{position: ['-120*sqrt(2)', 0, 0], fixed: [y, z, rx, ry]}}\n"
          "  apex: {{position: [0, '120*sqrt(2)', 0], fixed: [x]}}\n"  // of what slides freely, one place is held
          "  right: {{position: ['120*sqrt(2)', 0, 0], fixed: [y, z, rx, ry]}}\nelements:\n{}{}"
          "loads: {{a: {{node: left, moment: [0, 0, {}]}}, b: {{node: right, moment: [0, 0, {}]}}}}\n",
          leg("first", "left", "apex", elements), leg("second", "apex", "right", elements), sign, -sign));
      return frame.critical_load(600, 5, 1e-5, 1e-4);
    });
}
