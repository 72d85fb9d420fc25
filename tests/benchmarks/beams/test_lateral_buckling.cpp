// Lateral buckling loads, by the sign of the determinant of the tangent along the loaded plane path.
//
// References: critical loads of the geometrically exact rod by shooting, with the bending before buckling
// (tests/references/buckling.py).
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/benchmarks/beams/critical_load.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/static_model.hpp"

using namespace bielle::mechanism;
using bielle::test::check_load;
using bielle::test::StaticModel;

TEST_CASE("a cantilever strip buckles sideways under a dead load at its tip") {
  // P L^2/sqrt(EI_w GJ); 4.0126 for a strip that is rigid in its plane (S. Timoshenko, J. Gere, Theory of Elastic
  // Stability, art. 6.4), more where EI_w/EI_stiff = GJ/EI_stiff is not small.
  const bielle::test::ReferenceTable exact("buckling");
  for (const double ratio : {1e-3, 1e-2, 0.05, 0.1})
    check_load(exact(fmt::format("strip_{}", ratio)), [ratio](int elements) {
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
  // 100 x 10 mm, 1 m, E = 73 GPa, nu = 0.3; the reference has no extension and shear, which matter for 1e-4 here.
  const auto load = [](int elements) {
    StaticModel strip(fmt::format(
        "nodes: {{root: {{position: [0, 0, 0], fixed: true}}, tip: {{position: [1, 0, 0]}}}}\n"
        "elements: {{b: {{type: beam, nodes: [root, tip], orientation: [0, 1, 0], elements: {}, section: {{rectangle: "
        "[0.1, 0.01], young: 73e9, poisson: 0.3}}}}}}\nloads: {{p: {{node: tip, force: [0, -1, 0]}}}}\n",
        elements));
    return strip.critical_load(2500, 100, 1e-4, 1e-3);
  };
  CHECK_THAT((4 * load(16) - load(8)) / 3,
             Catch::WithinRel(bielle::test::ReferenceTable("buckling")("aluminium"), 1e-3));
}
