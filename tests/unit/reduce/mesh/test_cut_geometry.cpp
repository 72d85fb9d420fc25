// Tests of geometries that are cut before they are meshed.
#include "import_support.hpp"
#include <catch2/catch.hpp>

#include "reduce/mesh/cut_mesh.hpp"
#include "reduce/mesh/measures.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::reduce;
using namespace bielle::test;
using Catch::Matchers::WithinRel;

namespace {

// A bar of two materials, with surfaces at its ends and along one side.
const char* const bar =
    "SetFactory(\"OpenCASCADE\");\n"
    "Box(1) = {0, 0, 0, 60, 10, 10};\n"
    "Box(2) = {60, 0, 0, 40, 10, 10};\n"
    "BooleanFragments{Volume{1}; Delete;}{Volume{2}; Delete;}\n"
    "Physical Volume(\"soft\") = {1};\n"
    "Physical Volume(\"hard\") = {2};\n"
    "Physical Surface(\"left\") = Surface In BoundingBox {-1, -1, -1, 1, 11, 11};\n"
    "Physical Surface(\"right\") = Surface In BoundingBox {99, -1, -1, 101, 11, 11};\n"
    "Physical Surface(\"side\") = Surface In BoundingBox {-1, -1, -1, 101, 1, 11};\n";

MeshRequest bar_request(const std::string& path) {
  MeshRequest result = request(path);
  result.length_unit = "mm";
  result.size = 0.008;
  result.cuts = {{"cut_1", {0.03, 0, 0}, Eigen::Vector3d(1, 0.2, 0).normalized(), ""},
                 {"cut_2", {0.08, 0, 0}, Eigen::Vector3d(-1, 0, 0), ""}};
  return result;
}

}  // namespace

TEST_CASE("a geometry is cut by planes in its own unit, and groups keep their parts") {
  const TemporaryFolder folder;
  const MeshRequest wanted = bar_request(folder.file("bar.geo", bar));
  const Mesh mesh = import(wanted);
  CHECK_THAT(mesh_volume(mesh), WithinRel(1e-5, 1e-12));
  CHECK_THAT(area_vector(mesh, "left").x(), WithinRel(-1e-4, 1e-12));
  CHECK_THAT(area_vector(mesh, "right").x(), WithinRel(1e-4, 1e-12));
  CHECK_THAT(area_vector(mesh, "side").y(), WithinRel(-1e-3, 1e-12));
  const CutMesh cut = cut_mesh(mesh, wanted.cuts, "left");
  REQUIRE(cut.pieces.size() == 3);
  REQUIRE(cut.cuts.size() == 2);
  for (const MeshCut& surface : cut.cuts) CHECK(surface.distance < 1e-12);
  CHECK_THAT(corner_area(cut.pieces[0].mesh, "pieces.cut_1"), WithinRel(1e-4 * std::sqrt(1.04), 1e-12));
  // The prism is 30 mm long on one side and 28 mm on the other.
  CHECK_THAT(mesh_volume(cut.pieces[0].mesh), WithinRel(2.9e-6, 1e-12));
  CHECK_THAT(mesh_volume(cut.pieces[2].mesh), WithinRel(2e-6, 1e-12));
  CHECK(cut.pieces[0].mesh.groups.contains("soft"));
  CHECK_FALSE(cut.pieces[0].mesh.groups.contains("hard"));
  CHECK(cut.pieces[1].mesh.groups.contains("hard"));
  CHECK_FALSE(cut.pieces[2].mesh.groups.contains("soft"));
}

TEST_CASE("a STEP file is cut as well") {
  const TemporaryFolder folder;
  const std::string geo = folder.file("box.geo", "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 100, 10, 10};\n");
  gmsh_convert(geo, folder / "box.step", 0, 1);
  MeshRequest wanted = request(folder / "box.step");
  wanted.size = 0.008;
  wanted.cuts = {{"cut_1", {0.04, 0, 0}, {1, 0, 0}, ""}};
  const Mesh mesh = import(wanted);
  const CutMesh cut = cut_mesh(mesh, wanted.cuts, "");
  REQUIRE(cut.pieces.size() == 2);
  CHECK(cut.cuts[0].distance < 1e-12);
  CHECK_THAT(corner_area(cut.pieces[0].mesh, "pieces.cut_1"), WithinRel(1e-4, 1e-12));
}

TEST_CASE("a geometry of gmsh's own kernel is cut along element faces") {
  const TemporaryFolder folder;
  MeshRequest wanted = request(folder.file("box.geo",
                                           "Point(1) = {0, 0, 0}; Point(2) = {0, 1, 0}; Line(1) = {1, 2};\n"
                                           "s[] = Extrude {0, 0, 1} {Line{1};};\n"
                                           "Extrude {5, 0, 0} {Surface{s[1]};}\n"));
  wanted.size = 0.4;
  wanted.cuts = {{"cut_1", {2.03, 0, 0}, {1, 0, 0}, ""}};
  const Mesh mesh = import(wanted);
  const CutMesh cut = cut_mesh(mesh, wanted.cuts, "");
  REQUIRE(cut.pieces.size() == 2);
  CHECK(cut.cuts[0].distance > 0.01);
  CHECK(cut.cuts[0].distance < 0.8);
}
