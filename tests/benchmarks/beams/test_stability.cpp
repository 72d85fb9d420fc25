// Stability along load steps: the load at which it is lost, the number of unstable motions, and the branch that leaves
// there.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/statics.hpp"
#include "mechanism/io/mechanism_file.hpp"
#include "mechanism/session/session.hpp"
#include "tests/benchmarks/beams/critical_load.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle::mechanism;
using bielle::test::check_load;
using std::numbers::pi;

namespace test_stability {
namespace {

constexpr double EI = 2.1e11 * 0.01 * 0.02 * 0.02 * 0.02 / 12;  // bending stiffness about the weaker axis

struct Found {
  StaticsReport report;
  Vector3 tip = Vector3::Zero();
};

Found run(const std::string& text, int steps, double branch = 0) {
  const MechanismFile file = read_mechanism_text(text, "model.yaml");
  Session session(file.model);
  StaticsOptions options;
  options.steps = steps;
  options.branch = branch;
  Found found;
  found.report = compute_statics(session, options);
  found.tip = session.node("tip").x;
  return found;
}

/// The column is clamped at the foot and compressed along its axis by `load` times Euler's load of the weaker axis.
std::string column(int elements, double load,
                   const std::string& section = "{rectangle: [0.02, 0.01], young: 2.1e11, poisson: 0.3}",
                   const std::string& fixed = "[]", double stiffness = EI / 4) {
  return fmt::format(
      "nodes: {{foot: {{position: [0, 0, 0], fixed: true}}, tip: {{position: [1, 0, 0], fixed: {}}}}}\n"
      "elements: {{column: {{type: beam, nodes: [foot, tip], elements: {}, orientation: [0, 1, 0], section: {}}}}}\n"
      "loads: {{p: {{node: tip, force: [{:.17g}, 0, 0]}}}}\n",
      fixed, elements, section, -load * pi * pi / 4 * stiffness);
}

}  // namespace

TEST_CASE("a straight column at twice its critical load is reported unstable, from Euler's load on") {
  const Found found = run(column(16, 2), 10);
  CHECK(found.tip.tail<2>().norm() < 1e-9);  // it stays straight
  REQUIRE(found.report.log.critical.size() == 1);
  const CriticalPoint& point = found.report.log.critical[0];
  CHECK(point.before == 0);
  CHECK(point.after == 1);
  CHECK(found.report.log.unstable == 1);
  // The critical load is Euler's load reduced by shear and shortening, P = P_E (1 - P_E (1/GA_s - 1/EA)), G A_s = 5/6 G
  // A. The error of the elements is of fourth order.
  const double shear = pi * pi / 4 * (0.01 * 0.01 / 12) * (2.6 / (5.0 / 6) - 1);
  std::vector<double> errors;
  for (const int elements : {4, 8})
    errors.push_back(run(column(elements, 2), 4).report.log.critical.at(0).factor / (0.5 * (1 - shear)) - 1);
  CAPTURE(errors);
  CHECK(std::abs(errors[1]) < 2e-5);
  CHECK(std::abs(errors[1]) < 0.08 * std::abs(errors[0]));
}

TEST_CASE("a square column loses stability along two motions at once") {
  const Found found = run(
      column(8, 2, "{rectangle: [0.02, 0.02], young: 2.1e11, poisson: 0.3}", "[]", 2.1e11 * std::pow(0.02, 4) / 12), 5);
  REQUIRE(found.report.log.critical.size() == 1);
  CHECK(found.report.log.critical[0].before == 0);
  CHECK(found.report.log.critical[0].after == 2);
  CHECK(found.report.log.unstable == 2);
}

TEST_CASE("the branch of a column is its elastica") {
  // Tip angle of 60 degrees: k = sin 30, P/P_cr = (2 K/pi)^2, x/L = 2 E/K - 1, y/L = 2 k/K with K(k), E(k) of
  // M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions, table 17.1 (m = 0.25).
  constexpr double K = 1.685750354812596, E = 1.467462209339427, k = 0.5;
  const double load = std::pow(2 * K / pi, 2);
  const std::string thin = "{rectangle: [0.02, 0.001], young: 2.1e11, poisson: 0.3}";  // shear and stretch: 1e-6
  std::vector<double> errors;
  for (const int elements : {8, 16}) {
    const Found found = run(column(elements, load, thin, "[]", 2.1e11 * 0.02 * 1e-9 / 12), 10, 1e-3);
    REQUIRE(found.report.log.critical.size() == 1);
    CHECK(found.report.log.critical[0].left);
    CHECK(found.report.log.unstable == 0);
    errors.push_back(std::abs(std::abs(found.tip.tail<2>().norm()) - 2 * k / K) +
                     std::abs(found.tip[0] - (2 * E / K - 1)));
  }
  CAPTURE(errors);
  CHECK(errors[1] < 1e-4);
  CHECK(errors[1] < 0.35 * errors[0]);
}

TEST_CASE("the branch of a square column is the same elastica, to whatever side") {
  // The load is that of the case above; EI is the same about both axes.
  constexpr double K = 1.685750354812596, E = 1.467462209339427, k = 0.5;
  const Found found = run(
      column(16, std::pow(2 * K / pi, 2), "{EA: 1e6, GAy: 1e6, GAz: 1e6, GJ: 1, EIy: 1, EIz: 1}", "[]", 1), 10, 1e-3);
  REQUIRE(found.report.log.critical.size() == 1);
  CHECK(found.report.log.critical[0].after == 2);
  CHECK(found.report.log.critical[0].left);
  CHECK(found.report.log.unstable == 0);
  CHECK(found.tip.tail<2>().norm() == Approx(2 * k / K).epsilon(1e-3));
  CHECK(found.tip[0] == Approx(2 * E / K - 1).epsilon(1e-3));
}

TEST_CASE("a right-angle frame's critical loads are found by counting") {
  // The references are those of test_frame_buckling.cpp.
  const bielle::test::ReferenceTable exact("buckling");
  for (const int direction : {1, -1})
    check_load(exact(direction == 1 ? "saint_venant.away" : "saint_venant.towards"), [direction](int elements) {
      const std::string leg = fmt::format(
          "elements: {}, orientation: [0, 0, 1], section: {{rectangle: [0.6, 30], young: 71240, poisson: 0.31}}",
          elements);
      const Found found =
          run(fmt::format(
                  "nodes: {{root: {{position: [0, 0, 0], fixed: true}}, corner: {{position: [0, 240, 0]}}, tip: "
                  "{{position: [240, 240, 0]}}}}\nelements:\n  first: {{type: beam, nodes: [root, corner], {}}}\n  "
                  "second: {{type: beam, nodes: [corner, tip], {}}}\nloads: {{p: {{node: tip, force: [0, {}, 0]}}}}\n",
                  leg, leg, 1.5 * direction),
              8);
      return 1.5 * found.report.log.critical.at(0).factor;
    });
}

TEST_CASE("a path of a shallow arch meets its bifurcation before its limit point, and says so") {
  // As in test_paths.cpp.
  const std::string section =
      ", elements: 32, orientation: [0, 1, 0], section: {EA: 1e6, GAy: 1e9, GAz: 1e9, GJ: 1e9, EIy: 1e9, EIz: "
      "1e6/12}}\n";
  const MechanismFile file = read_mechanism_text(
      "nodes:\n  left: {position: [-50, 0, 0], fixed: [x, y, z, rx, ry]}\n  load: {position: [0, 5, 0]}\n"
      "  right: {position: [50, 0, 0], fixed: [x, y, z, rx, ry]}\nelements:\n"
      "  a: {type: beam, nodes: [left, load], arc_through: ['-252.5*sin(0.1)', '252.5*cos(0.1) - 247.5', 0]" +
          section +
          "  b: {type: beam, nodes: [load, right], arc_through: ['252.5*sin(0.1)', '252.5*cos(0.1) - 247.5', 0]" +
          section + "loads: {p: {node: load, force: [0, -1, 0]}}\n",
      "arch.yaml");
  Session session(file.model);
  StaticsOptions options;
  ContinuationOptions path;
  path.end.node = *file.model.find_node("load");
  path.end.direction = Vector3::UnitY();
  path.end.displacement = -3;
  options.steps = 0;
  options.path = path;
  const StaticsReport report = compute_statics(session, options);
  REQUIRE(report.limit_points.size() == 1);
  REQUIRE(report.log.critical.size() == 1);
  CHECK(report.log.critical[0].before == 0);
  CHECK(report.log.critical[0].after == 1);
  CHECK(report.log.critical[0].factor ==
        Approx(bielle::test::ReferenceTable("frames_and_arches")("shallow.sideways.P")).margin(0.05));
  CHECK(report.log.unstable == 2);  // to its side, and down
}

TEST_CASE("critical loads of one large increment are told one by one") {
  // Euler's loads of the column are 1, 9 and 25 times the first one; the load is 12 times the first one.
  const Found found = run(column(16, 12, "{EA: 3e7, GAy: 1e9, GAz: 1e9, GJ: 1e9, EIy: 1e9, EIz: 1}", "[]", 1), 1);
  REQUIRE(found.report.log.critical.size() == 2);
  CHECK(found.report.log.unstable == 2);
  CHECK(found.report.log.critical[0].factor == Approx(1.0 / 12).epsilon(1e-3));
  CHECK(found.report.log.critical[1].factor == Approx(9.0 / 12).epsilon(2e-3));
  CHECK(found.report.log.critical[0].after == 1);
  CHECK(found.report.log.critical[1].after == 2);
}

TEST_CASE("critical loads do not depend on the unit of length, nor on how the foot is held") {
  // A steel column of 10 m, in m and in mm, its foot fixed or joined rigidly.
  std::vector<double> factors;
  for (const double unit : {1.0, 1e-3})
    for (const bool joined : {false, true}) {
      const std::string text = fmt::format(
          "nodes: {{foot: {{position: [0, 0, 0]{}}}, tip: {{position: [{}, 0, 0]}}}}\n"
          "elements: {{column: {{type: beam, nodes: [foot, tip], elements: 8, orientation: [0, 1, 0], section: "
          "{{rectangle: [{}, {}], young: {}, poisson: 0.3}}}}}}\n{}loads: {{p: {{node: tip, force: [-4e6, 0, 0]}}}}\n",
          joined ? "" : ", fixed: true", 10 / unit, 0.346 / unit, 0.173 / unit, 2.1e11 * unit * unit,
          joined ? "joints: {clamp: {type: rigid, nodes: [ground, foot]}}\n" : "");
      factors.push_back(run(text, 4).report.log.critical.at(0).factor);
    }
  CAPTURE(factors);
  for (const double factor : factors) CHECK(factor == Approx(factors[0]).epsilon(1e-4));
}

TEST_CASE("an inverted pendulum on a spring is unstable where its weight outweighs the spring") {
  // The constants c are compared with m g l. Two rigid bodies are joined by constraints, so that the eigenvalues are
  // counted on the null space of the constraints.
  for (const double spring : {15.0, 30.0}) {
    const std::string text = fmt::format(
        "gravity: [0, 0, -9.81]\nnodes: {{tip: {{position: [0, 0, 1]}}}}\n"
        "elements: {{mass: {{type: rigid_body, node: tip, mass: 2, inertia: [0.01, 0.01, 0.01]}}}}\n"
        "joints: {{foot: {{type: hinge, nodes: [ground, tip], position: [0, 0, 0], axis: [0, 1, 0], "
        "stiffness: {}}}}}\n",
        spring);
    const Found found = run(text, 2);
    CAPTURE(spring);
    CHECK(found.report.log.unstable == (spring < 2 * 9.81 ? 1 : 0));
    if (spring < 2 * 9.81) CHECK(found.report.log.critical.at(0).factor == Approx(spring / (2 * 9.81)).epsilon(1e-6));
  }
}

}  // namespace test_stability
