// The 45-degree bend: K.-J. Bathe, S. Bolourchi, IJNME 14 (1979) 961.
//
// Arc of radius 100 in the plane x-y from the origin along y to (29.29, 70.71, 0), section 1 x 1, E = 1e7, nu = 0, tip
// load along z. The literature's tips for P = 600 spread from (15.5, 46.8, 53.7) to (15.9, 47.2, 53.4), with the mesh
// and the torsion constant. References here: the geometrically exact rod by shooting in long double, to 1e-9.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/static_analysis.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/solvers/statics/statics.hpp"
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
  /// Continues from the last load to P in steps of `step`.
  Vector3 tip(double P, double step) {
    const double from = dense.environment.load_factor == 1 && !moved_ ? 0 : dense.environment.load_factor;
    moved_ = true;
    const int steps = static_cast<int>(std::lround((P / 600 - from) * 600 / step));
    REQUIRE(load(steps, 1e-5, P / 600, from) >= 0);  // the floor of the residual is EA epsilon |x|/L = 1e-7
    return node("tip").x;
  }
  bool moved_ = false;
};

const std::string polar = "{EA: 1e7, GAy: 5e6, GAz: 5e6, GJ: 5e6/6, EIy: 1e7/12, EIz: 1e7/12}";

}  // namespace

TEST_CASE("the 45-degree bend converges with the square of the element length") {
  struct Case {
    std::string name, section;
    Vector3 at_300, at_450, at_600;
  };
  const std::vector<Case> cases{{"GA, polar GJ",
                                 polar,
                                 {22.244781, 58.779122, 40.191892},
                                 {18.508178925, 52.238558, 48.502927},
                                 {15.684800534, 47.150438574, 53.474858792}},
                                {"5/6 GA, polar GJ",
                                 "{EA: 1e7, GAy: 5e6*5/6, GAz: 5e6*5/6, GJ: 5e6/6, EIy: 1e7/12, EIz: 1e7/12}",
                                 {22.244679, 58.778897, 40.192392},
                                 {18.508065, 52.238262, 48.503492},
                                 {15.684689479, 47.150096240, 53.475477998}},
                                {"the section's own constants",
                                 "{rectangle: [1, 1], young: 1e7, poisson: 0}",
                                 {22.112514, 58.535709, 40.480757},
                                 {18.369163, 51.969425, 48.705349},
                                 {15.557676, 46.891586, 53.607986}}};
  for (const Case& c : cases)
    for (const char* bending : {"residual", "constant"}) {
      CAPTURE(c.name, bending);
      std::vector<Vector3> errors_300, errors_450, errors_600;
      for (int elements : {8, 16, 32}) {
        Bend bend(elements, c.section, bending);
        errors_300.emplace_back(bend.tip(300, 25) - c.at_300);
        errors_450.emplace_back(bend.tip(450, 25) - c.at_450);
        errors_600.emplace_back(bend.tip(600, 25) - c.at_600);
      }
      for (const auto& errors : {errors_300, errors_450, errors_600}) {
        CAPTURE(errors[0].transpose(), errors[1].transpose(), errors[2].transpose());
        // With the residual flexibility only the change of curvature by the load is left to the mesh; if bending and
        // torsion are equally stiff (the polar GJ is EI) even that is of fourth order.
        const bool constant = bending[0] == 'c', isotropic = c.name != "the section's own constants";
        if (!constant && isotropic)
          CHECK_THAT(std::log2(errors[0].norm() / errors[1].norm()), Catch::WithinAbs(4, 0.25));
        else
          CHECK_THAT(std::log2(errors[1].norm() / errors[2].norm()), Catch::WithinAbs(2, 0.25));
        CHECK(errors[2].norm() < (constant ? 2e-2 : isotropic ? 5e-6 : 2e-4));
        if (constant) CHECK(((4 * errors[2] - errors[1]) / 3).norm() < 2e-4);
      }
    }
}

TEST_CASE("the 45-degree bend of few elements of constant strain as an independent program has it") {
  struct Case {
    int elements;
    Vector3 tip;
  };
  for (const Case& c : {Case{1, {17.8769, 53.3958, 44.4125}}, Case{2, {16.1198, 48.5237, 51.1607}},
                        Case{4, {15.7906, 47.4790, 52.9053}}, Case{8, {15.7111, 47.2319, 53.3332}}}) {
    CAPTURE(c.elements);
    CHECK((Bend(c.elements, polar, "constant").tip(600, 50) - c.tip).cwiseAbs().maxCoeff() < 6e-5);  // four decimals
  }
}

TEST_CASE("the load steps of a static analysis find the 45-degree bend, also from one step") {
  const MechanismFile file = read_mechanism_text(
      "nodes: {root: {position: [0, 0, 0], fixed: true}, tip: {position: ['100 - 50*sqrt(2)', '50*sqrt(2)', 0]}}\n"
      "elements: {b: {type: beam, nodes: [root, tip], arc_centre: [100, 0, 0], elements: 16, section: " +
          polar + "}}\nloads: {p: {node: tip, force: [0, 0, 600]}}\n",
      "bend.yaml");
  const System system(file.model);
  for (int steps : {1, 4, 12}) {
    State state = system.start(0);
    solve_statics(system, file.model.environment, steps, NewtonOptions{}, state);
    CHECK((state.nodes[2].x - Vector3(15.684800534, 47.150438574, 53.474858792)).norm() < 1e-4);
  }
}

TEST_CASE("the 45-degree bend at five times the usual load by the steps that the program chooses") {
  // P = 3000; the tip goes up by 68.5. References as above.
  struct Case {
    std::string section;
    Vector3 exact;
  };
  for (const Case& c :
       {Case{polar, {4.232875917, 23.024308225, 68.539089493}},
        Case{"{EA: 1e7, GAy: 5e6*5/6, GAz: 5e6*5/6, GJ: 5e6/6, EIy: 1e7/12, EIz: 1e7/12}",
             {4.232850791, 23.023589455, 68.540398996}},
        Case{"{rectangle: [1, 1], young: 1e7, poisson: 0}", {4.213966855, 22.958001273, 68.524190791}}}) {
    std::vector<double> errors;
    for (const int elements : {8, 16, 32}) {
      const MechanismFile file = read_mechanism_text(
          fmt::format("nodes: {{root: {{position: [0, 0, 0], fixed: true}}, tip: {{position: ['100 - 50*sqrt(2)', "
                      "'50*sqrt(2)', 0]}}}}\nelements: {{b: {{type: beam, nodes: [root, tip], arc_centre: [100, 0, 0], "
                      "elements: {}, section: {}}}}}\nloads: {{p: {{node: tip, force: [0, 0, 3000]}}}}\n"
                      "analysis: [{{type: static, steps: auto}}]\n",
                      elements, c.section),
          "bend.yaml");
      const System system(file.model);
      State state = system.start(0);
      const auto& analysis = dynamic_cast<const StaticAnalysis&>(*file.analyses.front());
      solve_statics(system, file.model.environment, analysis.options().steps, NewtonOptions{}, state);
      errors.push_back((state.nodes[2].x - c.exact).norm());
    }
    CAPTURE(c.section, errors);
    CHECK(std::log2(errors[0] / errors[1]) > 1.9);
    CHECK(std::log2(errors[1] / errors[2]) > 1.9);
    CHECK(errors[2] < 1e-3);
  }
}
