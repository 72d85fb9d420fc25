// Tests of meshes that are cut along planes: cells, surfaces, names, and planes that cannot cut.
#include <cmath>
#include <set>

#include "import_support.hpp"
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/mesh/cut_mesh.hpp"
#include "reduce/mesh/measures.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/messages.hpp"

using namespace bielle;
using namespace bielle::reduce;
using namespace bielle::test;
using Catch::Contains;

namespace {

CutPlane plane(const std::string& name, const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  return {name, point, normal.normalized(), "pieces." + name};
}

CutPlane across(const std::string& name, double x) { return plane(name, {x, 0, 0}, {1, 0, 0}); }

double volume(const CutMesh& cut) {
  double sum = 0;
  for (const MeshPart& piece : cut.pieces) sum += mesh_volume(piece.mesh);
  return sum;
}

}  // namespace

TEST_CASE("a box is cut exactly if faces of its cells lie in the planes") {
  const Mesh mesh = box_mesh({{1, 0.2, 0.1}, {8, 2, 1}});
  const CutMesh cut = cut_mesh(mesh, {across("cut_1", 0.25), across("cut_2", 0.75)}, "x0");
  REQUIRE(cut.pieces.size() == 3);
  for (const auto& [piece, length] : {std::pair{0, 0.25}, {1, 0.5}, {2, 0.25}})
    CHECK(mesh_volume(cut.pieces[piece].mesh) == Approx(length * 0.02).epsilon(1e-12));
  REQUIRE(cut.cuts.size() == 2);
  for (const MeshCut& surface : cut.cuts) {
    CHECK(surface.distance < 1e-15);
    // The normal points out of the lower piece along x, and into it from the other piece.
    const double outward = area_vector(cut.pieces[surface.pieces[0]].mesh, surface.group).x();
    CHECK(outward == Approx(0.02).epsilon(1e-12));
    CHECK(area_vector(cut.pieces[surface.pieces[1]].mesh, surface.group).x() == Approx(-0.02).epsilon(1e-12));
  }
  CHECK(cut.cuts[1].pieces == std::array<int, 2>{1, 2});
  CHECK(cut.cuts[1].group == "pieces.cut_2");
  // Groups of surfaces belong to the pieces that they bound, and groups of volumes to all pieces.
  CHECK(cut.pieces[0].mesh.groups.contains("x0"));
  CHECK_FALSE(cut.pieces[1].mesh.groups.contains("x0"));
  CHECK_FALSE(cut.pieces[1].mesh.groups.contains("x1"));
  double side = 0;
  for (const MeshPart& piece : cut.pieces) {
    side += area_vector(piece.mesh, "y0").y();
    CHECK(piece.mesh.groups.at("solid").parts[0].cells.size() == static_cast<std::size_t>(piece.mesh.solid_count()));
    CHECK(piece.mesh.points == mesh.points(Eigen::all, piece.nodes));
  }
  CHECK(side == Approx(-0.1).epsilon(1e-12));
}

TEST_CASE("pieces are numbered from the first interface") {
  const Mesh mesh = box_mesh({{1, 0.2, 0.1}, {8, 2, 1}});
  const CutMesh cut = cut_mesh(mesh, {across("b", 0.75), across("a", 0.25)}, "x1");
  CHECK(cut.pieces[0].mesh.groups.contains("x1"));
  CHECK(cut.pieces[2].mesh.groups.contains("x0"));
  CHECK(cut.cuts[0].name == "b");
  CHECK(cut.cuts[0].pieces == std::array<int, 2>{0, 1});
}

TEST_CASE("otherwise a cut follows the cell faces next to the plane, and the pieces fill the body") {
  const Mesh mesh = distorted_box_mesh({{1, 0.3, 0.3}, {12, 3, 3}}, 0.2);
  for (const double x : {0.37, 0.52, 0.61}) {
    const CutPlane oblique = plane("cut_1", {x, 0.15, 0.15}, {1, 0.3, -0.2});
    const CutMesh cut = cut_mesh(mesh, {oblique}, "x0");
    REQUIRE(cut.pieces.size() == 2);
    REQUIRE(cut.cuts.size() == 1);
    CHECK(volume(cut) == Approx(mesh_volume(mesh)).epsilon(1e-12));
    CHECK(cut.cuts[0].distance > 1e-3);
    CHECK(cut.cuts[0].distance < 0.15);  // the longest edge is about 0.2
    // Both sides are the same surface, and its area vector is that of a closed section.
    const Eigen::Vector3d a = area_vector(cut.pieces[0].mesh, "pieces.cut_1");
    CHECK((a + area_vector(cut.pieces[1].mesh, "pieces.cut_1")).norm() < 1e-15);
    CHECK(a.x() == Approx(0.09).epsilon(1e-12));
  }
}

TEST_CASE("a plane through both legs of a body makes one cut in each") {
  // The body is half of a ring in the plane of x and y, with both ends at y = 0.
  const Mesh mesh = box_mesh({{1, 0.1, 0.1}, {16, 1, 1}}, [](const Eigen::Vector3d& x) {
    const double angle = std::acos(-1.0) * x.x(), radius = 1 + x.y();
    return Eigen::Vector3d(-radius * std::cos(angle), radius * std::sin(angle), x.z());
  });
  const CutMesh cut = cut_mesh(mesh, {plane("cut_1", {0, 0.4, 0}, {0, 1, 0})}, "x1");
  REQUIRE(cut.pieces.size() == 3);
  CHECK(cut.pieces[0].mesh.groups.contains("x1"));
  REQUIRE(cut.cuts.size() == 2);
  CHECK(std::set<std::string>{cut.cuts[0].name, cut.cuts[1].name} == std::set<std::string>{"cut_1_1", "cut_1_2"});
  CHECK(volume(cut) == Approx(mesh_volume(mesh)).epsilon(1e-12));
}

TEST_CASE("the message about a plane that cannot cut the body tells the reason") {
  const Mesh mesh = box_mesh({{1, 0.2, 0.2}, {8, 2, 2}});
  const auto message = [&](const std::vector<CutPlane>& planes) {
    return message_of<InputError>([&] { cut_mesh(mesh, planes, "x0"); });
  };
  CHECK_THAT(message({across("cut_1", 0.5), across("far", 1.5)}),
             Contains("pieces.far: 'far' does not cut the body, which lies between -1.5 m and -0.5 m"));
  // A plane in the end face is not a cut.
  CHECK_THAT(message({across("end", 1)}), Contains("does not cut the body"));
  // There is no piece between two planes in one layer of cells.
  CHECK_THAT(message({across("cut_1", 0.5), across("cut_2", 0.502)}), Contains("less than an element apart"));
}
