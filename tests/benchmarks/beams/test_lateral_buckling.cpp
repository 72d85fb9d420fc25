// Lateral buckling loads, by the sign of the determinant of the tangent along the loaded plane path.
//
// References: critical loads of the geometrically exact rod by shooting (1e-8), with the bending before buckling.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/static_model.hpp"

using namespace bielle::mechanism;
using bielle::test::StaticModel;

namespace {

/// Loads for three meshes approach the reference with the square of the element length.
template <class Load>
void check_load(double exact, const Load& load) {
  std::vector<double> errors;
  for (int elements : {4, 8, 16}) errors.push_back(load(elements) / exact - 1);
  CAPTURE(exact, errors);
  CHECK_THAT(std::log2(errors[0] / errors[1]), Catch::WithinAbs(2, 0.2));
  CHECK_THAT(std::log2(errors[1] / errors[2]), Catch::WithinAbs(2, 0.1));
  CHECK(std::abs(errors[2]) < 5e-3);
  CHECK(std::abs(4 * errors[2] - errors[1]) / 3 < 1e-4);
}

}  // namespace

TEST_CASE("a cantilever strip buckles sideways under a dead load at its tip") {
  // P L^2/sqrt(EI_w GJ); 4.0126 for a strip that is rigid in its plane (S. Timoshenko, J. Gere, Theory of Elastic
  // Stability, art. 6.4), more where EI_w/EI_stiff = GJ/EI_stiff is not small.
  for (const auto& [ratio, exact] :
       {std::pair{1e-3, 4.017194831150}, {1e-2, 4.059627405541}, {0.05, 4.274845155223}, {0.1, 4.624632264476}})
    check_load(exact, [ratio = ratio](int elements) {
      StaticModel strip(
          fmt::format("nodes: {{root: {{position: [0, 0, 0], fixed: true}}, tip: {{position: [1, 0, 0]}}}}\n"
                      "elements: {{b: {{type: beam, nodes: [root, tip], orientation: [0, 1, 0], elements: {}, section: "
                      "{{EA: 1e7, GAy: "
                      "1e7, GAz: 1e7, GJ: 1, EIy: 1, EIz: {}}}}}}}\nloads: {{p: {{node: tip, force: [0, -1, 0]}}}}\n",
                      elements, 1 / ratio));
      return strip.critical_load(3, 0.5, 1e-7, 1e-7);
    });
}

TEST_CASE("a strip of aluminium with the torsion constant of its rectangle") {
  // 100 x 10 mm, 1 m, E = 73 GPa, nu = 0.3: GJ = 876.912605 N m^2, P = 2973.84093 N without extension and shear, which
  // matter for 1e-4 here.
  const auto load = [](int elements) {
    StaticModel strip(fmt::format(
        "nodes: {{root: {{position: [0, 0, 0], fixed: true}}, tip: {{position: [1, 0, 0]}}}}\n"
        "elements: {{b: {{type: beam, nodes: [root, tip], orientation: [0, 1, 0], elements: {}, section: {{rectangle: "
        "[0.1, 0.01], young: 73e9, poisson: 0.3}}}}}}\nloads: {{p: {{node: tip, force: [0, -1, 0]}}}}\n",
        elements));
    return strip.critical_load(2500, 100, 1e-4, 1e-3);
  };
  CHECK_THAT((4 * load(16) - load(8)) / 3, Catch::WithinRel(2973.84093, 1e-3));
}

namespace {

/// A frame of two legs of 240, section 30 x 0.6 in its plane, E = 71240, nu = 0.31. J. Argyris et al., Comput. Methods
/// Appl. Mech. Eng. 17/18 (1979) 1.
std::string leg(const std::string& name, const std::string& from, const std::string& to, int elements) {
  return fmt::format(
      "  {}: {{type: beam, nodes: [{}, {}], elements: {}, orientation: [0, 0, 1], section: {{rectangle: [0.6, 30], "
      "young: "
      "71240, poisson: 0.31}}}}\n",
      name, from, to, elements);
}

}  // namespace

TEST_CASE("a cantilever right-angle frame buckles out of its plane") {
  // Published 1.088 and 0.680 with GJ = G h b^3/3; these with Saint-Venant's constant. The load at the tip is parallel
  // to the first leg.
  for (const auto& [direction, exact] : {std::pair{1, 1.0840875933}, {-1, 0.6789283208}})
    check_load(exact, [direction = direction](int elements) {
      StaticModel frame(
          "nodes: {root: {position: [0, 0, 0], fixed: true}, corner: {position: [0, 240, 0]}, tip: {position: [240, "
          "240, 0]}}\n"
          "elements:\n" +
          leg("first", "root", "corner", elements) + leg("second", "corner", "tip", elements) +
          fmt::format("loads: {{p: {{node: tip, force: [0, {}, 0]}}}}\n", direction));
      return frame.critical_load(0.5, 0.05, 1e-6, 1e-8);
    });
}

TEST_CASE("a cantilever right-angle frame under a load along its second leg") {
  // References of four digits, with GJ = G h b^3/3; the load acts towards the corner or away from it.
  for (const auto& [direction, exact] : {std::pair{-1, 0.6508}, {1, 3.979}}) {
    const auto load = [direction = direction](int elements) {
      const auto thin = [&](const std::string& name, const std::string& ends) {
        return fmt::format(
            "  {}: {{type: beam, nodes: {}, elements: {}, orientation: [0, 0, 1], section: {{EA: 71240*18, GAy: "
            "71240/2.62*15, GAz: 71240/2.62*15, GJ: 71240/2.62*2.16, EIy: 71240*1350, EIz: 71240*0.54}}}}\n",
            name, ends, elements);
      };
      StaticModel frame(
          "nodes: {root: {position: [0, 0, 0], fixed: true}, corner: {position: [0, 240, 0]}, tip: {position: [240, "
          "240, 0]}}\nelements:\n" +
          thin("first", "[root, corner]") + thin("second", "[corner, tip]") +
          fmt::format("loads: {{p: {{node: tip, force: [{}, 0, 0]}}}}\n", direction));
      return frame.critical_load(0.3, 0.1, 1e-6, 1e-6);
    };
    CHECK_THAT((4 * load(16) - load(8)) / 3, Catch::WithinRel(exact, 2e-4));
  }
}

TEST_CASE("a hinged right-angle frame buckles under end moments of either sign") {
  // Ends slide along x and turn about z; published 622.2 with GJ = G h b^3/3.
  for (const int sign : {1, -1})
    check_load(618.2869, [sign](int elements) {
      StaticModel frame(fmt::format(
          "nodes:\n  left: {{position: ['-120*sqrt(2)', 0, 0], fixed: [y, z, rx, ry]}}\n"
          "  apex: {{position: [0, '120*sqrt(2)', 0], fixed: [x]}}\n"  // of what slides freely, one place is held
          "  right: {{position: ['120*sqrt(2)', 0, 0], fixed: [y, z, rx, ry]}}\nelements:\n{}{}"
          "loads: {{a: {{node: left, moment: [0, 0, {}]}}, b: {{node: right, moment: [0, 0, {}]}}}}\n",
          leg("first", "left", "apex", elements), leg("second", "apex", "right", elements), sign, -sign));
      return frame.critical_load(600, 5, 1e-5, 1e-4);
    });
}
