// Snap-through of frames and arches along the whole path by the program's own arc length.
//
// References: Reissner's rod with linear strains by shooting along the path (tests/references/frames_and_arches.py). P
// is the load, u and v the displacements of its point along x and down.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "mechanism/analyses/static_analysis.hpp"
#include "mechanism/solvers/statics/arc_length.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/run_model.hpp"

using namespace bielle::mechanism;
using bielle::test::ReadyModel;

namespace test_paths {
namespace {

struct Point {
  double P, u, v;
};

double number(const std::string& name) {
  static const bielle::test::ReferenceTable table("frames_and_arches");
  return table(name);
}

Point point_of(const std::string& name) { return {number(name + ".P"), number(name + ".u"), number(name + ".v")}; }

/// Follows the path of a model whose first analysis defines its end. The node `load` carries a unit load.
struct Path {
  std::vector<Point> limits;
  Point end{};
  explicit Path(const std::string& text) {
    const ReadyModel model(text);
    State state = model.system.start(0);
    const Vector3 drawn = model.node(state, "load").x;
    const auto point = [&](const State& s, double P) {
      const Vector3 moved = model.node(s, "load").x - drawn;
      return Point{P, moved.x(), -moved.y()};
    };
    const StaticsOptions& options = dynamic_cast<const StaticAnalysis&>(*model.file.analyses.front()).options();
    const Loaded loaded = follow_by_continuation(model.system, model.environment(), {}, *options.path, options.newton,
                                                 state, [&](const State& s, const PathPoint& p) {
                                                   if (p.limit) limits.push_back(point(s, p.load_factor));
                                                 });
    end = point(state, loaded.factor);
  }
};

std::string until(const std::string& direction, double displacement) {
  return fmt::format(
      "analysis: [{{type: static, arc_length: {{until: {{node: load, direction: {}, displacement: {:.17g}}}}}}}]\n",
      direction, displacement);
}

std::string lees_frame(int elements, double GA, const std::string& end) {
  const std::string section =
      fmt::format("section: {{EA: 4320, GAy: {0:.17g}, GAz: {0:.17g}, GJ: 1e3, EIy: 1440, EIz: 1440}}}}\n", GA);
  return "nodes:\n  base: {position: [0, 0, 0], fixed: [x, y, z, rx, ry]}\n  corner: {position: [0, 120, 0]}\n"
         "  load: {position: [24, 120, 0]}\n  end: {position: [120, 120, 0], fixed: [x, y, z, rx, ry]}\nelements:\n" +
         fmt::format("  column: {{type: beam, nodes: [base, corner], elements: {}, orientation: [1, 0, 0], {}",
                     elements, section) +
         fmt::format("  left: {{type: beam, nodes: [corner, load], elements: {}, orientation: [0, 1, 0], {}",
                     elements / 5, section) +
         fmt::format("  right: {{type: beam, nodes: [load, end], elements: {}, orientation: [0, 1, 0], {}",
                     4 * elements / 5, section) +
         "loads: {p: {node: load, force: [0, -1, 0]}}\n" + end;
}

std::string deep_arch(int elements, double EA, double GA, const std::string& end) {
  const std::string section = fmt::format(
      "arc_centre: [0, 0, 0], elements: {}, orientation: [0, 1, 0], section: {{EA: {}, GAy: {}, GAz: {}, GJ: 1e6, EIy: "
      "1e6, EIz: 1e6}}}}\n",
      elements, EA, GA, GA);
  return "parameters: {half: 215*pi/360}\nnodes:\n"
         "  left: {position: [-100*sin(half), 100*cos(half), 0], fixed: true}\n  load: {position: [0, 100, 0]}\n"
         "  right: {position: [100*sin(half), 100*cos(half), 0], fixed: [x, y, z, rx, ry]}\nelements:\n"
         "  a: {type: beam, nodes: [left, load], " +
         section + "  b: {type: beam, nodes: [load, right], " + section +
         "loads: {p: {node: load, force: [0, -1, 0]}}\n" + end;
}

/// Values of three meshes, each twice as fine as the one before, approach the exact one with order 2 or better.
void check_order(const std::vector<double>& values, double exact, double tolerance) {
  std::vector<double> errors;
  for (const double value : values) errors.push_back(std::abs(value / exact - 1));
  CAPTURE(exact, values, errors);
  for (std::size_t k = 0; k + 1 < errors.size(); ++k) CHECK(std::log2(errors[k] / errors[k + 1]) > 1.9);
  CHECK(errors.back() < tolerance);
}

std::vector<double> each(const std::vector<Point>& points, double Point::*member) {
  std::vector<double> values;
  for (const Point& point : points) values.push_back(point.*member);
  return values;
}

}  // namespace

TEST_CASE("Lee's frame: both limit points of the program's path, with full, reduced and no shear flexibility") {
  // S. Lee, F. Manuel, E. Rossow, J. Eng. Mech. Div. ASCE 94 (1968): column and beam of 120, A = 6, I = 2, E = 720, nu
  // = 0.3, both ends pinned, load 24 from the corner. The literature has 1.85 to 1.87, depending on the mesh.
  const double GA = 4320 / 2.6, none = 1e7;
  struct Case {
    double GA;
    std::string name;
  };
  for (const Case& c : {Case{GA, "lee"}, Case{5.0 / 6 * GA, "lee_reduced_shear"}, Case{none, "lee_without_shear"}}) {
    const Point exact = point_of(c.name + ".first");
    std::vector<Point> first, second;
    for (const int elements : {5, 10, 20}) {
      const Path path(lees_frame(elements, c.GA, until("y", -65)));
      REQUIRE(path.limits.size() == 2);
      first.push_back(path.limits[0]);
      second.push_back(path.limits[1]);
    }
    CAPTURE(c.GA);
    check_order(each(first, &Point::P), exact.P, 1e-4);
    check_order(each(first, &Point::u), exact.u, 1e-3);
    check_order(each(first, &Point::v), exact.v, 1e-3);
    check_order(each(second, &Point::P), number(c.name + ".second.P"), 1e-3);
  }
}

TEST_CASE("Lee's frame: points of the path before, between and past its limit points") {
  // u grows until 94.3 and then decreases; v decreases twice before. Each end of a path is reached where the
  // displacement first has this value.
  for (const int k : {1, 2, 3, 4, 5}) {
    const Point exact = point_of(fmt::format("lee.end_{}", k));
    const std::string until_end = k <= 3 ? until("x", exact.u) : until("y", -exact.v);
    std::vector<double> errors;
    for (const int elements : {5, 10, 20}) {  // from 40 on only a small part of second order is left, 1e-6
      const Point end = Path(lees_frame(elements, 4320 / 2.6, until_end)).end;
      errors.push_back(std::hypot((end.P - exact.P), (end.u - exact.u) / 120, (end.v - exact.v) / 120));
    }
    CAPTURE(until_end, errors);
    CHECK(std::log2(errors[0] / errors[1]) > 1.9);
    CHECK(std::log2(errors[1] / errors[2]) > 1.9);
    CHECK(errors[2] < 1e-4);
  }
}

TEST_CASE("a deep arch of 215 degrees, clamped and hinged: both limit points of the program's path") {
  // D. DaDeppo, R. Schmidt, J. Appl. Mech. 42 (1975) 923 (8.97 EI/R^2 when inextensible): R = 100, EI = 1e6, EA = 1e8,
  // GA = 5e7.
  std::vector<Point> first, second;
  for (const int elements : {10, 20, 40}) {
    const Path path(deep_arch(elements, 1e8, 5e7, until("y", -125)));
    REQUIRE(path.limits.size() == 2);
    first.push_back(path.limits[0]);
    second.push_back(path.limits[1]);
  }
  check_order(each(first, &Point::P), number("deep.first.P"), 1e-4);
  check_order(each(first, &Point::u), number("deep.first.u"), 1e-4);
  check_order(each(first, &Point::v), number("deep.first.v"), 1e-4);
  check_order(each(second, &Point::P), number("deep.second.P"), 1e-3);
}

TEST_CASE("the deep arch past its first limit point") {
  const Point exact = point_of("deep.end");
  std::vector<Point> ends;
  for (const int elements : {10, 20, 40}) ends.push_back(Path(deep_arch(elements, 1e8, 5e7, until("x", exact.u))).end);
  check_order(each(ends, &Point::P), exact.P, 1e-3);
  check_order(each(ends, &Point::v), exact.v, 1e-4);
}

TEST_CASE("the limit load of the deep arch without extension and shear") {
  // EA = GA = 1e10 reduces the effect of EA = 1e8 and GA = 5e7 to 1e-2 of it: 3e-7 of the load.
  std::vector<double> loads;
  for (const int elements : {10, 20, 40})
    loads.push_back(Path(deep_arch(elements, 1e10, 1e10, until("y", -116))).limits.front().P);
  check_order(loads, number("deep_stiff.first.P"), 1e-4);
}

TEST_CASE("a shallow arch: the path passes its bifurcation and both limit points") {
  // Span 100, rise 5, E = 1e6, A = 1, I = 1/12, hinged at both ends; the crown may move to either side. The symmetric
  // path has a bifurcation at P = 75.00, beyond which it continues; past the lower limit point it passes shapes of more
  // waves.
  const double with_shear = 5.0 / 6 * 1e6 / 2.6, without_shear = 1e9;
  for (const double GA : {without_shear, with_shear}) {
    const std::string name = GA == without_shear ? "shallow" : "shallow_shear";
    std::vector<Point> upper, lower;
    for (const int elements : {4, 8, 16}) {  // at 32 only a part of second order is left, 2e-6
      const std::string section = fmt::format(
          ", elements: {}, orientation: [0, 1, 0], section: {{EA: 1e6, GAy: {}, GAz: {}, GJ: 1e5, EIy: 1e6/12, EIz: "
          "1e6/12}}}}\n",
          elements, GA, GA);
      const Path path(
          "nodes:\n  left: {position: [-50, 0, 0], fixed: [x, y, z, rx, ry]}\n  load: {position: [0, 5, 0]}\n"
          "  right: {position: [50, 0, 0], fixed: [x, y, z, rx, ry]}\nelements:\n"
          "  a: {type: beam, nodes: [left, load], arc_through: ['-252.5*sin(0.1)', '252.5*cos(0.1) - 247.5', 0]" +
          section +
          "  b: {type: beam, nodes: [load, right], arc_through: ['252.5*sin(0.1)', '252.5*cos(0.1) - 247.5', 0]" +
          section + "loads: {p: {node: load, force: [0, -1, 0]}}\n" + until("y", -10));
      REQUIRE(path.limits.size() >= 2);
      CHECK(std::abs(path.end.u) < 1e-6);  // still symmetric
      upper.push_back(path.limits[0]);
      lower.push_back(path.limits[1]);
    }
    CAPTURE(GA);
    check_order(each(upper, &Point::P), number(name + ".upper.P"), 1e-3);
    check_order(each(upper, &Point::v), number(name + ".upper.v"), 1e-3);
    if (GA == without_shear) check_order(each(lower, &Point::P), number(name + ".lower.P"), 1e-3);
  }
}

}  // namespace test_paths
