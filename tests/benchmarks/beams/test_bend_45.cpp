// The 45-degree bend: K.-J. Bathe, S. Bolourchi, IJNME 14 (1979) 961.
//
// Arc of radius 100 in the plane x-y from the origin along y to (29.29, 70.71, 0), section 1 x 1, E = 1e7, nu = 0, tip
// load along z. The literature's tips for P = 600 spread from (15.5, 46.8, 53.7) to (15.9, 47.2, 53.4), with the mesh
// and the torsion constant. References here: the geometrically exact rod by shooting (tests/references/bend_45.py).
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/static_analysis.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/statics/statics.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/static_model.hpp"

using namespace bielle::mechanism;
using bielle::test::StaticModel;

namespace {

struct Bend : StaticModel {
  Bend(int elements, const std::string& section, const std::string& bending)
      : StaticModel(fmt::format(
            "nodes: {{root: {{position: [0, 0, 0], fixed: true}}, tip: {{position: ['100 - 50*sqrt(2)', '50*sqrt(2)', "
            "0]}}}}\nelements: {{b: {{type: beam, nodes: [root, tip], arc_centre: [100, 0, 0], bending: {}, elements: "
            "{}, "
            "section: {}}}}}\nloads: {{p: {{node: tip, force: [0, 0, 600]}}}}\n",
            bending, elements, section)) {}
  /// Continues from the last load to P in increments of `step`.
  Vector3 tip(double P, double step) {
    const double from = dense.environment.load_factor == 1 && !moved_ ? 0 : dense.environment.load_factor;
    moved_ = true;
    const int steps = static_cast<int>(std::lround((P / 600 - from) * 600 / step));
    REQUIRE(load(steps, 1e-5, P / 600, from) >= 0);  // the residual cannot fall below EA epsilon |x|/L = 1e-7
    return node("tip").x;
  }
  bool moved_ = false;
};

const std::string polar = "{EA: 1e7, GAy: 5e6, GAz: 5e6, GJ: 5e6/6, EIy: 1e7/12, EIz: 1e7/12}";

/// Sections by their names in the table of references: GA and the polar GJ, 5/6 GA, and the section's own constants.
const std::pair<std::string, std::string> sections[] = {
    {"polar", polar},
    {"reduced_shear", "{EA: 1e7, GAy: 5e6*5/6, GAz: 5e6*5/6, GJ: 5e6/6, EIy: 1e7/12, EIz: 1e7/12}"},
    {"own", "{rectangle: [1, 1], young: 1e7, poisson: 0}"}};

}  // namespace

TEST_CASE("the 45-degree bend converges with the square of the element length") {
  const bielle::test::ReferenceTable table("bend_45");
  for (const auto& [name, section] : sections)
    for (const char* bending : {"residual", "constant"}) {
      CAPTURE(name, bending);
      const auto exact = [&table, row = name + "."](const char* load) { return table.vector(row + load); };
      std::vector<Vector3> errors_300, errors_450, errors_600;
      for (int elements : {8, 16, 32}) {
        Bend bend(elements, section, bending);
        errors_300.emplace_back(bend.tip(300, 25) - exact("300"));
        errors_450.emplace_back(bend.tip(450, 25) - exact("450"));
        errors_600.emplace_back(bend.tip(600, 25) - exact("600"));
      }
      for (const auto& errors : {errors_300, errors_450, errors_600}) {
        CAPTURE(errors[0].transpose(), errors[1].transpose(), errors[2].transpose());
        // With the residual flexibility, the mesh has to represent only the change of curvature by the load. If bending
        // and torsion are equally stiff (the polar GJ equals EI), the error is of fourth order.
        const bool constant = bending[0] == 'c', isotropic = name != "own";
        if (!constant && isotropic)
          CHECK_THAT(std::log2(errors[0].norm() / errors[1].norm()), Catch::WithinAbs(4, 0.25));
        else
          CHECK_THAT(std::log2(errors[1].norm() / errors[2].norm()), Catch::WithinAbs(2, 0.25));
        CHECK(errors[2].norm() < (constant ? 2e-2 : isotropic ? 5e-6 : 2e-4));
        if (constant) CHECK(((4 * errors[2] - errors[1]) / 3).norm() < 2e-4);
      }
    }
}

TEST_CASE("the 45-degree bend of few elements of constant strain is where their energy is least") {
  const bielle::test::ReferenceTable exact("bend_45_elements");
  for (const int elements : {1, 2, 4, 8}) {
    CAPTURE(elements);
    const Vector3 tip = exact.vector(fmt::format("{}.tip", elements));
    CHECK((Bend(elements, polar, "constant").tip(600, 50) - tip).cwiseAbs().maxCoeff() < 6e-5);
  }
}

TEST_CASE("the load steps of a static analysis find the 45-degree bend, also from one step") {
  const MechanismFile file = read_mechanism_text(
      "nodes: {root: {position: [0, 0, 0], fixed: true}, tip: {position: ['100 - 50*sqrt(2)', '50*sqrt(2)', 0]}}\n"
      "elements: {b: {type: beam, nodes: [root, tip], arc_centre: [100, 0, 0], elements: 16, section: " +
          polar + "}}\nloads: {p: {node: tip, force: [0, 0, 600]}}\n",
      "bend.yaml");
  const System system(file.model);
  const Vector3 exact = bielle::test::ReferenceTable("bend_45").vector("polar.600");
  for (int steps : {1, 4, 12}) {
    State state = system.start(0);
    solve_statics(system, file.model.environment, steps, NewtonOptions{}, state);
    CHECK((state.nodes[2].x - exact).norm() < 1e-4);
  }
}

TEST_CASE("the 45-degree bend at five times the usual load by the steps that the program chooses") {
  // P is 3000, and the tip rises by 68.5. The references are those of the case above.
  for (const auto& [name, section] : sections) {
    const Vector3 exact = bielle::test::ReferenceTable("bend_45").vector(name + ".3000");
    std::vector<double> errors;
    for (const int elements : {8, 16, 32}) {
      const MechanismFile file = read_mechanism_text(
          fmt::format("nodes: {{root: {{position: [0, 0, 0], fixed: true}}, tip: {{position: ['100 - 50*sqrt(2)', "
                      "'50*sqrt(2)', 0]}}}}\nelements: {{b: {{type: beam, nodes: [root, tip], arc_centre: [100, 0, 0], "
                      "elements: {}, section: {}}}}}\nloads: {{p: {{node: tip, force: [0, 0, 3000]}}}}\n"
                      "analysis: [{{type: static, steps: auto}}]\n",
                      elements, section),
          "bend.yaml");
      const System system(file.model);
      State state = system.start(0);
      const auto& analysis = dynamic_cast<const StaticAnalysis&>(*file.analyses.front());
      solve_statics(system, file.model.environment, analysis.options().steps, NewtonOptions{}, state);
      errors.push_back((state.nodes[2].x - exact).norm());
    }
    CAPTURE(name, errors);
    CHECK(std::log2(errors[0] / errors[1]) > 1.9);
    CHECK(std::log2(errors[1] / errors[2]) > 1.9);
    CHECK(errors[2] < 1e-3);
  }
}
