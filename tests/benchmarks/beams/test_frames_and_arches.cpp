// Lee's frame and a deep arch up to and past their limit points, and the bifurcation of a shallow arch.
//
// Paths and limit points by shooting, Reissner's rod with linear strains (tests/references/frames_and_arches.py).
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/reference_table.hpp"
#include "tests/support/static_model.hpp"

using namespace bielle::mechanism;
using bielle::test::StaticModel;

namespace {

struct PathPoint {
  double P, u, v;  ///< load, displacements of its point: horizontal, down
};

double path_value(const std::string& name) {
  static const bielle::test::ReferenceTable table("frames_and_arches");
  return table(name);
}

/// Returns three points of a path.
std::vector<PathPoint> path_of(const std::string& model) {
  std::vector<PathPoint> path;
  for (const char* load : {".load_1", ".load_2", ".load_3"})
    path.push_back({path_value(model + load + ".P"), path_value(model + load + ".u"), path_value(model + load + ".v")});
  return path;
}

/// Errors at the points of a path decrease with order 2 or better over three meshes (with order 4 if bending
/// dominates).
template <class Model>
void check_path(const Model& make, const std::vector<PathPoint>& path, const Vector3& start, double step,
                double tolerance, double size) {
  std::vector<std::vector<Eigen::Vector2d>> errors;
  for (int elements : {10, 20, 40}) {
    StaticModel model = make(elements);
    errors.emplace_back();
    double P = 0;
    for (const PathPoint& point : path) {
      REQUIRE(model.load(static_cast<int>(std::ceil((point.P - P) / step)), tolerance, point.P, P) >= 0);
      P = point.P;
      const Vector3 moved = model.node("load").x - start;
      errors.back().emplace_back(moved.x() - point.u, -moved.y() - point.v);
    }
  }
  for (std::size_t k = 0; k < path.size(); ++k) {
    CAPTURE(path[k].P, errors[0][k].transpose(), errors[1][k].transpose(), errors[2][k].transpose());
    CHECK(std::log2(errors[0][k].norm() / errors[1][k].norm()) > 1.9);
    CHECK(std::log2(errors[1][k].norm() / errors[2][k].norm()) > 1.9);
    CHECK(errors[2][k].norm() < 2e-6 * size);
  }
}

/// Returns the extreme load between two positions of the loaded point along a direction, by parabolas through three
/// successively closer points.
double extreme_load(StaticModel& model, int direction, double low, double high, double tolerance) {
  const auto P = [&](double u) { return model.control("load", direction, u, 8, tolerance); };
  for (int k = 0; k < 4; ++k) {
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
    const double a = P(low), b = P(middle), c = P(high);
    const double off = 0.5 * half * (a - c) / (a - 2 * b + c);
    low = middle + off - 0.2 * half;
    high = middle + off + 0.2 * half;
  }
  return P(0.5 * (low + high));
}

void check_order(const std::vector<double>& values, double exact) {
  std::vector<double> errors;
  for (const double value : values) errors.push_back(std::abs(value / exact - 1));
  CAPTURE(exact, errors);
  for (std::size_t k = 0; k + 1 < errors.size(); ++k) CHECK(std::log2(errors[k] / errors[k + 1]) > 1.9);
}

StaticModel lees_frame(int elements) {
  const std::string section = ", section: {EA: 4320, GAy: 4320/2.6, GAz: 4320/2.6, GJ: 1e3, EIy: 1440, EIz: 1440}}\n";
  return StaticModel(
      "nodes:\n  base: {position: [0, 0, 0], fixed: [x, y, z, rx, ry]}\n  corner: {position: [0, 120, 0]}\n"
      "  load: {position: [24, 120, 0]}\n  end: {position: [120, 120, 0], fixed: [x, y, z, rx, ry]}\nelements:\n" +
      fmt::format("  column: {{type: beam, nodes: [base, corner], orientation: [1, 0, 0], elements: {}{}", elements,
                  section) +
      fmt::format("  left: {{type: beam, nodes: [corner, load], orientation: [0, 1, 0], elements: {}{}", elements / 5,
                  section) +
      fmt::format("  right: {{type: beam, nodes: [load, end], orientation: [0, 1, 0], elements: {}{}", 4 * elements / 5,
                  section) +
      "loads: {p: {node: load, force: [0, -1, 0]}}\n");
}

StaticModel deep_arch(int elements) {
  const std::string section =
      ", orientation: [0, 1, 0], section: {EA: 1e8, GAy: 5e7, GAz: 5e7, GJ: 1e6, EIy: 1e6, EIz: 1e6}}\n";
  return StaticModel(
      "parameters: {half: 215*pi/360}\nnodes:\n  left: {position: [-100*sin(half), 100*cos(half), 0], fixed: true}\n"
      "  load: {position: [0, 100, 0]}\n"
      "  right: {position: [100*sin(half), 100*cos(half), 0], fixed: [x, y, z, rx, ry]}\nelements:\n" +
      fmt::format("  a: {{type: beam, nodes: [left, load], arc_centre: [0, 0, 0], elements: {}{}", elements, section) +
      fmt::format("  b: {{type: beam, nodes: [load, right], arc_centre: [0, 0, 0], elements: {}{}", elements, section) +
      "loads: {p: {node: load, force: [0, -1, 0]}}\n");
}

}  // namespace

TEST_CASE("Lee's frame up to 94 percent of its limit load") {
  // S. Lee, F. Manuel, E. Rossow, J. Eng. Mech. Div. ASCE 94 (1968): column and beam of 120, A = 6, I = 2, E = 720, nu
  // = 0.3 (here GA = G A), both ends pinned, load 24 from the corner.
  check_path(lees_frame, path_of("lee"), {24, 120, 0}, 0.1, 1e-9, 120);
}

TEST_CASE("a deep arch of 215 degrees, clamped and hinged, up to 95 percent of its limit load") {
  // D. DaDeppo, R. Schmidt, J. Appl. Mech. 42 (1975) 923 (8.97 EI/R^2 when inextensible): R = 100, EI = 1e6, EA = 1e8,
  // GA = 5e7.
  check_path(deep_arch, path_of("deep"), {0, 100, 0}, 50, 1e-4, 100);
}

TEST_CASE("the limit loads of Lee's frame, before and after its snap") {
  // The horizontal displacement of the loaded point grows along the whole path; the vertical one decreases in between.
  std::vector<double> first, second;
  for (const int elements : {5, 10, 20}) {
    StaticModel frame = lees_frame(elements);
    frame.keep_directions({0, 1, 5});
    REQUIRE(frame.load(14, 1e-9, 1.4) >= 0);  // at first u grows with the square of the load only
    frame.control("load", 0, 48, 20, 1e-9);
    first.push_back(extreme_load(frame, 0, 24 + 24, 24 + 30, 1e-9));
    frame.control("load", 0, 110, 60, 1e-9);
    second.push_back(extreme_load(frame, 0, 110, 116, 1e-9));
  }
  check_order(first, path_value("lee.first.P"));
  check_order(second, path_value("lee.second.P"));
  CHECK_THAT(first.back(), Catch::WithinRel(path_value("lee.first.P"), 1e-3));
  CHECK_THAT(second.back(), Catch::WithinRel(path_value("lee.second.P"), 1e-2));
}

TEST_CASE("the limit load of the deep arch") {
  std::vector<double> loads;
  for (const int elements : {10, 20, 40}) {
    StaticModel arch = deep_arch(elements);
    arch.keep_directions({0, 1, 5});
    REQUIRE(arch.load(10, 1e-4, 500) >= 0);
    arch.control("load", 0, 60, 120, 1e-4);
    loads.push_back(extreme_load(arch, 0, 60, 62, 1e-4));
  }
  check_order(loads, path_value("deep.first.P"));
  CHECK_THAT(loads.back(), Catch::WithinRel(path_value("deep.first.P"), 1e-3));
}

TEST_CASE("von Mises' truss of two springs snaps through as its closed form") {
  // Span 2 b, rise h, EA = 7: P(w) = 2 EA (h - w)/L0 (L0/L - 1), L^2 = b^2 + (h - w)^2, engineering strain.
  const double b = 3, h = 1, EA = 7, L0 = std::hypot(b, h);
  StaticModel truss(fmt::format(
      "nodes: {{left: {{position: [-3, 0, 0], fixed: true}}, load: {{position: [0, 1, 0]}}, right: {{position: [3, 0, "
      "0], fixed: true}}}}\nelements:\n  l: {{type: spring_damper, nodes: [left, load], stiffness: {0}}}\n  r: {{type: "
      "spring_damper, nodes: [right, load], stiffness: {0}}}\nloads: {{p: {{node: load, force: [0, -1, 0]}}}}\n",
      EA / L0));
  truss.keep_directions({1});
  for (const double w : {0.1, 0.4, 0.9, 1.0, 1.1, 1.7, 2.0, 2.5}) {
    const double L = std::hypot(b, h - w);
    CHECK_THAT(truss.control("load", 1, h - w, 2, 1e-13),
               Catch::WithinAbs(2 * EA * (h - w) / L0 * (L0 / L - 1), 1e-12));
  }
}

namespace {

/// Span 100, rise 5, E = 1e6, A = 1, I = 1/12, hinged at both ends. @param GA  1e9: as good as without shear
StaticModel shallow_arch(int elements, double GA) {
  const std::string section = fmt::format(
      ", elements: {}, orientation: [0, 1, 0], section: {{EA: 1e6, GAy: {}, GAz: {}, GJ: 1e5, EIy: 1e6/12, EIz: "
      "1e6/12}}}}\n",
      elements, GA, GA);
  StaticModel arch(
      "nodes:\n  left: {position: [-50, 0, 0], fixed: [x, y, z, rx, ry]}\n  load: {position: [0, 5, 0]}\n"
      "  right: {position: [50, 0, 0], fixed: [x, y, z, rx, ry]}\nelements:\n"
      "  a: {type: beam, nodes: [left, load], arc_through: ['-252.5*sin(0.1)', '252.5*cos(0.1) - 247.5', 0]" +
      section + "  b: {type: beam, nodes: [load, right], arc_through: ['252.5*sin(0.1)', '252.5*cos(0.1) - 247.5', 0]" +
      section + "loads: {p: {node: load, force: [0, -1, 0]}}\n");
  arch.keep_directions({0, 1, 5});
  return arch;
}

constexpr double without_shear = 1e9, with_shear = 5.0 / 6 * 1e6 / 2.6;

}  // namespace

TEST_CASE("a shallow arch bifurcates to its side before it snaps through") {
  for (const double GA : {without_shear, with_shear}) {
    const std::string row = GA == without_shear ? "shallow.sideways." : "shallow_shear.sideways.";
    const double critical = path_value(row + "P");
    StaticModel arch = shallow_arch(16, GA);
    CHECK(arch.load(10, 1e-6, 60) >= 0);
    CHECK_THAT(arch.critical_load(60, 2, 1e-6, 1e-4), Catch::WithinAbs(critical, 0.12));  // 16 elements a side: 1e-3
    CHECK_THAT(5 - arch.node("load").x.y(), Catch::WithinAbs(path_value(row + "v"), 0.01));
  }
}

TEST_CASE("the limit load of a shallow arch that is kept symmetric") {
  std::vector<double> upper, upper_with_shear;
  for (const int elements : {4, 8, 16}) {  // at 32 only a part of second order is left, 2e-6
    for (const double GA : {without_shear, with_shear}) {
      StaticModel arch = shallow_arch(elements, GA);
      REQUIRE(arch.load(10, 1e-6, 60) >= 0);
      arch.control("load", 1, 5 - 2.3, 20, 1e-6);
      (GA == without_shear ? upper : upper_with_shear).push_back(extreme_load(arch, 1, 5 - 2.5, 5 - 2.3, 1e-6));
    }
  }
  check_order(upper, path_value("shallow.upper.P"));
  check_order(upper_with_shear, path_value("shallow_shear.upper.P"));
  CHECK_THAT(upper.back(), Catch::WithinRel(path_value("shallow.upper.P"), 1e-5));
  CHECK_THAT(upper_with_shear.back(), Catch::WithinRel(path_value("shallow_shear.upper.P"), 1e-4));
}
