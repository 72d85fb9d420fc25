// Tests of the keys of `mesh` that change the cells of a geometry: hexahedra, sizes from curvature, healing.
#include <numbers>
#include <set>

#include "import_support.hpp"
#include <catch2/catch.hpp>

#include "reduce/mesh/checks.hpp"
#include "reduce/mesh/measures.hpp"
#include "reduce/mesh/solid_cells.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::reduce;
using namespace bielle::test;
using Catch::Contains;
using Catch::Matchers::WithinRel;

namespace {

const std::string open_cascade = "SetFactory(\"OpenCASCADE\");\n";

MeshRequest hexahedral(const std::string& path, double size, int order = 2) {
  MeshRequest result = request(path);
  result.size = size;
  result.order = order;
  result.hexahedra = true;
  return result;
}

// Returns the types of the solid cells.
std::set<CellType> solid_types(const Mesh& mesh) {
  std::set<CellType> types;
  const SolidCells cells(mesh);
  for (const SolidCells::Range& range : cells.ranges()) types.insert(range.type);
  return types;
}

// Returns the number of corner nodes on a circle about the z axis at z = 0.
int nodes_on_circle(const Mesh& mesh, double radius) {
  int count = 0;
  for (const auto& x : mesh.points.colwise())
    count += std::abs(x.z()) < 1e-9 && std::abs(x.head<2>().norm() - radius) < 1e-6 * radius;
  return count;
}

}  // namespace

TEST_CASE("blocks are meshed by grids of hexahedra") {
  const TemporaryFolder folder;
  const std::string box = folder.file("box.geo", open_cascade + "Box(1) = {0, 0, 0, 4, 2, 1};\n");
  const Mesh mesh = import(hexahedral(box, 0.5));
  CHECK(solid_types(mesh) == std::set{CellType::hex20});
  CHECK_THAT(mesh_volume(mesh), WithinRel(8.0, 1e-12));
  CHECK_THAT(mesh_quality(mesh).least_scaled_jacobian, WithinRel(1.0, 1e-9));
  CHECK(mesh_quality(mesh).longest_edge < 0.5 + 1e-9);
  CHECK(solid_types(import(hexahedral(box, 0.5, 1))) == std::set{CellType::hex8});

  // The body is a quarter of a tube. Quadratic edges of 90/8 degrees cause a relative error of the area of about
  // angle^4 / 100.
  const std::string tube = folder.file(
      "tube.geo", open_cascade +
                      "Cylinder(1) = {0, 0, 0, 0, 0, 1, 2, Pi/2}; Cylinder(2) = {0, 0, 0, 0, 0, 1, 1, Pi/2};\n"
                      "BooleanDifference(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};\n");
  const Mesh quarter = import(hexahedral(tube, 0.4));
  CHECK(solid_types(quarter) == std::set{CellType::hex20});
  CHECK(mesh_quality(quarter).least_scaled_jacobian > 0.9);
  CHECK_THAT(mesh_volume(quarter), WithinRel(0.75 * std::numbers::pi, 2e-5));
}

TEST_CASE("glued blocks have one grid") {
  const TemporaryFolder folder;
  MeshRequest wanted = hexahedral(folder.file("boxes.geo", open_cascade + "Box(1) = {0, 0, 0, 2, 1, 1};\n"
                                                                          "Box(2) = {2, 0, 0, 1, 1, 1};\n"),
                                  0.5);
  wanted.glue = true;
  const Mesh mesh = import(wanted);
  CHECK(solid_types(mesh) == std::set{CellType::hex20});
  CHECK_THAT(mesh_volume(mesh), WithinRel(3.0, 1e-12));
  CHECK_THAT(mesh_quality(mesh).least_scaled_jacobian, WithinRel(1.0, 1e-9));
}

TEST_CASE("other geometries are meshed with tetrahedra, which are divided into hexahedra") {
  const TemporaryFolder folder;
  const std::string cylinder = folder.file("cylinder.geo", open_cascade + "Cylinder(1) = {0, 0, 0, 0, 0, 5, 1};\n");
  for (const int order : {1, 2}) {
    const Mesh mesh = import(hexahedral(cylinder, 0.4, order));
    CHECK(solid_types(mesh) == std::set{order == 1 ? CellType::hex8 : CellType::hex20});
    CHECK(mesh_quality(mesh).least_scaled_jacobian > 0.05);
    // Straight edges of length s cause an error of at most s^2 / 6 r^2 of the area of a circle; here s = 0.4.
    CHECK_THAT(mesh_volume(mesh), WithinRel(5 * std::numbers::pi, order == 1 ? 0.4 * 0.4 / 6 : 1e-3));
  }
  MeshRequest angle = hexahedral(
      folder.file("angle.geo", open_cascade + "Box(1) = {0, 0, 0, 4, 1, 1}; Box(2) = {0, 0, 1, 1, 1, 2};\n"), 0.5);
  angle.glue = true;
  const Mesh mesh = import(angle);
  CHECK(solid_types(mesh) == std::set{CellType::hex20});
  CHECK_THAT(mesh_volume(mesh), WithinRel(6.0, 1e-12));
}

TEST_CASE("hexahedra that a geometry defines are kept") {
  const TemporaryFolder folder;
  const Mesh mesh =
      import(hexahedral(folder.file("layers.geo",
                                    "Point(1) = {0, 0, 0}; l[] = Extrude {3, 0, 0} {Point{1}; Layers{3};};\n"
                                    "s[] = Extrude {0, 1, 0} {Line{l[1]}; Layers{2}; Recombine;};\n"
                                    "Extrude {0, 0, 1} {Surface{s[1]}; Layers{1}; Recombine;}\n"),
                        0.7));
  CHECK(solid_types(mesh) == std::set{CellType::hex20});
  CHECK(mesh.solid_count() == 6);
}

TEST_CASE("hexahedra have the sizes given for surfaces, and surfaces by shape are found") {
  const TemporaryFolder folder;
  MeshRequest wanted =
      hexahedral(folder.file("cylinder.geo", open_cascade + "Cylinder(1) = {0, 0, 0, 0, 0, 5, 1};\n"), 0.6);
  wanted.surfaces = {selection("end", ShapeSelector(PlaneSelector{{0, 0, 0}, {0, 0, 1}}))};
  const Mesh coarse = import(wanted);
  wanted.sizes = {{"end", {0.3, ""}}};
  const Mesh fine = import(wanted);
  CHECK(solid_types(fine) == std::set{CellType::hex20});
  const auto cells_of = [](const Mesh& mesh) { return mesh.groups.at("end").parts.front().cells.size(); };
  CHECK(cells_of(fine) > 2 * cells_of(coarse));
}

TEST_CASE("curvature gives the number of edges on a circle, down to a twentieth of the size") {
  const TemporaryFolder folder;
  MeshRequest wanted = request(folder.file("cylinder.geo", open_cascade + "Cylinder(1) = {0, 0, 0, 0, 0, 2, 1};\n"));
  wanted.size = 2;
  wanted.order = 1;
  CHECK(nodes_on_circle(import(wanted), 1) < 24);
  wanted.curvature = 40;
  const int count = nodes_on_circle(import(wanted), 1);
  CHECK(count >= 40);
  CHECK(count <= 42);
  wanted.curvature = 360;
  CHECK(nodes_on_circle(import(wanted), 1) <= 2 * std::numbers::pi / 0.1 + 2);
}

TEST_CASE("healing removes a sliver of a face, and keeps the solid") {
  const TemporaryFolder folder;
  // The upper face of a block has a notch of depth 0.01, whose side faces are slivers.
  const std::string geo =
      folder.file("notch.geo", open_cascade +
                                   "Box(1) = {0, 0, 0, 50, 20, 10}; Box(2) = {20, 0, 9.99, 10, 20, 1};\n"
                                   "BooleanDifference(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};\n");
  gmsh_convert(geo, folder / "notch.step", 0, 1);
  MeshRequest wanted = request(folder / "notch.step");
  wanted.size = 0.004;
  wanted.order = 1;
  CHECK(mesh_quality(import(wanted)).shortest_edge < 2e-5);
  wanted.heal = true;
  const Mesh mesh = import(wanted);
  CHECK(mesh_quality(mesh).shortest_edge > 4e-4);
  CHECK_THAT(mesh_volume(mesh), WithinRel(1e-5, 1e-3));
}

TEST_CASE("geometries that cannot be healed are refused") {
  const TemporaryFolder folder;
  MeshRequest wanted = request(folder.file("box.geo",
                                           "Point(1) = {0, 0, 0}; Point(2) = {0, 1, 0}; Line(1) = {1, 2};\n"
                                           "s[] = Extrude {0, 0, 1} {Line{1};}; Extrude {2, 0, 0} {Surface{s[1]};}\n"));
  wanted.size = 0.5;
  wanted.heal = true;
  CHECK_THAT(import_message(wanted), Contains("of gmsh's own kernel, which cannot be healed"));
  wanted.path =
      folder.file("named.geo", open_cascade + "Box(1) = {0, 0, 0, 2, 1, 1}; Physical Surface(\"end\") = {1};\n");
  CHECK_THAT(import_message(wanted), Contains("has physical surfaces (end ..), which healing would lose"));
  wanted.path = folder.file("plain.geo", open_cascade + "Box(1) = {0, 0, 0, 2, 1, 1};\n");
  CHECK_THAT(mesh_volume(import(wanted)), WithinRel(2.0, 1e-9));
  wanted.size.reset();
  CHECK_THAT(import_message(wanted), Contains("small against `size`: give it too"));
}

TEST_CASE("the keys that change the cells of a geometry are refused for meshes") {
  const TemporaryFolder folder;
  gmsh_convert(folder.file("box.geo", open_cascade + "Box(1) = {0, 0, 0, 2, 1, 1};\n"), folder / "box.msh", 0.5, 1);
  const MeshRequest plain = request(folder / "box.msh");
  MeshRequest cells = plain, curvature = plain, heal = plain;
  cells.hexahedra = false;
  curvature.curvature = 12;
  heal.heal = true;
  for (const MeshRequest& wanted : {cells, curvature, heal})
    CHECK_THAT(import_message(wanted), Contains("is a mesh already: remove this key"));
}
