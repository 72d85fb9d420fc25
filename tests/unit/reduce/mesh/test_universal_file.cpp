// Tests of universal files: coordinate systems of nodes, and the unit of length. The body is a tetrahedron of volume a
// b c / 6 with its right angle at the origin.
#include <array>
#include <cmath>
#include <string>

#include "import_support.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/mesh/measures.hpp"
#include "reduce/mesh/universal_file.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::reduce;
using namespace bielle::test;
using Catch::Contains;

namespace {

using Point = std::array<double, 3>;
constexpr double a = 3, b = 2, c = 1.5;

const std::array<Point, 4> own = {Point{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};

std::string numbers(const Point& x) { return fmt::format("{:25.16E}{:25.16E}{:25.16E}\n", x[0], x[1], x[2]); }

/// @param system  kind of the system, and its axes and origin as four rows
std::string tetrahedron(const std::string& units, int kind, const std::array<Point, 4>& system,
                        const std::array<Point, 4>& nodes, int number = 7) {
  std::string text = units;
  text += "    -1\n  2420\n         1\nPart\n         1         0         0\nGlobal\n";
  for (const Point& row : own) text += numbers(row);
  text += fmt::format("         7{:10d}         0\nOwn\n", kind);
  for (const Point& row : system) text += numbers(row);
  text += "    -1\n    -1\n  2411\n";
  for (std::size_t k = 0; k < 4; ++k)
    text += fmt::format("{:10d}{:10d}         1        11\n", k + 1, number) + numbers(nodes[k]);
  return text +
         "    -1\n    -1\n  2412\n         1       111         2         1         7         4\n"
         "         1         2         3         4\n    -1\n";
  return text;
}

std::string units(double factor) {
  return fmt::format(
      "    -1\n   164\n         5  mm (milli-newton)           2\n{:25.16E}{:25.16E}{:25.16E}\n"
      "    2.7314999999999998D+2\n    -1\n",
      factor, factor, 1.0);
}

const std::array<Point, 4> cartesian = {Point{0, 0, 0}, {a, 0, 0}, {0, b, 0}, {0, 0, c}};
const std::array<Point, 4> cylindrical = {Point{0, 0, 0}, {a, 0, 0}, {b, 90, 0}, {0, 0, c}};
const std::array<Point, 4> spherical = {Point{0, 0, 0}, {a, 90, 0}, {b, 90, 90}, {c, 0, 0}};

}  // namespace

TEST_CASE("nodes of universal files may be given in any kind of coordinate system") {
  const TemporaryFolder folder;
  // The system has x' along y, y' along z, z' along x, and its origin at (10, 0, 0).
  const std::array<Point, 4> turned = {Point{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {10, 0, 0}};
  struct Case {
    int kind;
    std::array<Point, 4> system, nodes;
    Eigen::Vector3d farthest;
  };
  for (const Case& each :
       {Case{0, own, cartesian, {a, b, c}}, Case{1, own, cylindrical, {a, b, c}}, Case{2, own, spherical, {a, b, c}},
        Case{0, turned, cartesian, {10 + c, a, b}}, Case{1, turned, cylindrical, {10 + c, a, b}}}) {
    CAPTURE(each.kind);
    const Mesh mesh = import(request(folder.file("body.unv", tetrahedron("", each.kind, each.system, each.nodes))));
    CHECK(mesh_volume(mesh) == Approx(a * b * c / 6).epsilon(1e-12));
    CHECK((mesh.points.rowwise().maxCoeff() - each.farthest).norm() < 1e-12);
  }
}

TEST_CASE("the unit of a universal file is used unless the body file states another one") {
  const TemporaryFolder folder;
  const std::string path = folder.file("body.unv", tetrahedron(units(1000), 0, own, cartesian));
  CHECK(universal_length_unit(path) == Approx(1e-3).epsilon(1e-15));
  CHECK(mesh_volume(import(request(path))) == Approx(a * b * c / 6 * 1e-9).epsilon(1e-12));
  MeshRequest in_metres = request(path);
  in_metres.length_unit.emplace("m");
  CHECK(mesh_volume(import(in_metres)) == Approx(a * b * c / 6).epsilon(1e-12));
  const std::string none = folder.file("none.unv", tetrahedron("", 0, own, cartesian));
  CHECK_FALSE(universal_length_unit(none));
  CHECK(mesh_volume(import(request(none))) == Approx(a * b * c / 6).epsilon(1e-12));
}

TEST_CASE("messages about damaged universal files tell the line") {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& text) { return import_message(request(folder.file("bad.unv", text))); };
  CHECK_THAT(said(tetrahedron(units(0), 0, own, cartesian)),
             Contains("line 4") && Contains("a factor of lengths of 0"));
  CHECK_THAT(said(tetrahedron("", 3, own, cartesian)), Contains("coordinate system 7 of kind 3"));
  CHECK_THAT(said(tetrahedron("", 1, own, cartesian, 9)), Contains("node 1 stands in the coordinate system 9"));
  std::array<Point, 4> infinite = cylindrical;
  infinite[1][0] = INFINITY;
  CHECK_THAT(said(tetrahedron("", 1, own, infinite)), Contains("expected 3 numbers in dataset 2411"));
}
