// Tests of the selection of surfaces by shape, on geometries and on meshes without names.
#include <cmath>
#include <numbers>

#include "import_support.hpp"
#include <catch2/catch.hpp>

#include "reduce/mesh/selectors.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::reduce;
using namespace bielle::test;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinRel;

namespace {

// A plate of 0.2 x 0.1 x 0.02 with a bore of radius 0.03 about (0.05, 0.05) and one of 0.02 about (0.15, 0.05).
const char* const plate_geo =
    "SetFactory(\"OpenCASCADE\"); Box(1) = {0,0,0, .2,.1,.02};\n"
    "Cylinder(2) = {.05,.05,-1, 0,0,2, .03}; Cylinder(3) = {.15,.05,-1, 0,0,2, .02};\n"
    "BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2,3}; Delete; };\n";

MeshRequest plate_request(const std::string& path, bool meshed) {
  MeshRequest result = request(path);
  if (!meshed) result.size = 0.01;
  result.surfaces = {selection("bore", CylinderSelector{{0.05, 0.05, 7}, {0, 0, -2}, 0.03}),
                     selection("top", PlaneSelector{{9, 9, 0.02}, {0, 0, 3}}),
                     selection("end", BoxSelector{{0.2, 0, 0}, {0.2, 0.1, 0.02}})};
  return result;
}

}  // namespace

TEST_CASE(
    "cylinder, plane and box select the same surfaces of a geometry, of a STEP file without names and of a mesh") {
  const TemporaryFolder folder;
  const std::string geo = folder.file("plate.geo", plate_geo);
  // gmsh writes numbers to STEP unchanged and declares them as mm.
  const std::string scaled =
      folder.file("plate_mm.geo", std::string(plate_geo) + "Dilate {{0,0,0}, 1000} { Volume{4}; }\n");
  gmsh_convert(scaled, folder / "plate.step", 10, 2);
  gmsh_convert(geo, folder / "plate.msh", 0.01, 2);
  gmsh_convert(geo, folder / "linear.msh", 0.01, 1);
  for (const std::string name : {"plate.geo", "plate.step", "plate.msh", "linear.msh"}) {
    CAPTURE(name);
    const Mesh mesh = import(plate_request(folder / name, name.ends_with(".msh")));
    // The circumference of an inscribed polygon has the relative error (h/r)^2/24, 0.5 % at h = r/3.
    CHECK_THAT(corner_area(mesh, "bore"), WithinRel(2 * std::numbers::pi * 0.03 * 0.02, 1e-2));
    CHECK_THAT(corner_area(mesh, "top"), WithinRel(0.02 - std::numbers::pi * (0.0009 + 0.0004), 1e-2));
    CHECK((area_vector(mesh, "end") - Eigen::Vector3d(0.002, 0, 0)).norm() < 1e-9);
    CHECK(area_vector(mesh, "bore").norm() < 1e-9);  // the area vector of a closed ring is zero
    for (int node : mesh.groups.at("bore").nodes)
      CHECK(std::hypot(mesh.points(0, node) - 0.05, mesh.points(1, node) - 0.05) ==
            Approx(0.03).margin(name == "linear.msh" ? 1e-9 : 2e-4));
  }
}

TEST_CASE("one selection may unite several surfaces, including a physical one") {
  const TemporaryFolder folder;
  const std::string path =
      folder.file("plate.geo", std::string(plate_geo) +
                                   "Physical Surface(\"small\") = Surface In BoundingBox {.12,.02,-1, .18,.08,1};\n");
  MeshRequest wish = request(path);
  wish.size = 0.01;
  wish.surfaces = {{"both", {CylinderSelector{{0.05, 0.05, 0}, {0, 0, 1}, 0.03}, std::string("small")}, ""}};
  const Mesh mesh = import(wish);
  CHECK_THAT(corner_area(mesh, "both"), WithinRel(2 * std::numbers::pi * 0.05 * 0.02, 1e-2));
}

TEST_CASE("several shapes in one selector select their intersection") {
  // The fork has two coaxial bores of one radius, in two cheeks whose outer faces are parallel planes.
  const TemporaryFolder folder;
  MeshRequest wish = request(folder.file("fork.geo",
                                         "SetFactory(\"OpenCASCADE\"); Box(1) = {0,0,0, .1,.04,.01}; Box(2) = "
                                         "{0,0,.03, .1,.04,.01}; Box(3) = {0,0,0, .02,.04,.04};\n"
                                         "Cylinder(4) = {.08,.02,-1, 0,0,2, .01};\n"
                                         "BooleanUnion(5) = { Volume{1}; Delete; }{ Volume{2,3}; Delete; };\n"
                                         "BooleanDifference(6) = { Volume{5}; Delete; }{ Volume{4}; Delete; };\n"));
  wish.size = 0.004;
  const CylinderSelector bores{{0.08, 0.02, 0}, {0, 0, 1}, 0.01};
  const BoxSelector lower{{0, 0, 0}, {0.1, 0.04, 0.01}};
  wish.surfaces = {selection("both", bores), selection("one", ShapeSelector(bores, {}, lower))};
  const Mesh mesh = import(wish);
  CHECK_THAT(corner_area(mesh, "one"), WithinRel(2 * std::numbers::pi * 0.01 * 0.01, 1e-2));
  CHECK_THAT(corner_area(mesh, "both"), WithinRel(2 * corner_area(mesh, "one"), 1e-2));
  wish.surfaces = {selection("none", ShapeSelector(bores, {}, BoxSelector{{0, 0, 0}, {0.1, 0.04, 0.009}}))};
  CHECK_THAT(import_message(wish), Contains("lies on the cylinder with radius 0.01 m about (0.08, 0.02, 0) m along (0, "
                                            "0, 1) and in the box from (0, 0, 0) m") &&
                                       Contains("a surface must lie in the box as a whole; the nearest cylinders are: "
                                                "a cylinder from (0.07, 0.01, 0) m to (0.09, 0.03, 0.01) m"));
}

TEST_CASE("the message about a selector that finds nothing names the nearest shapes") {
  const TemporaryFolder folder;
  const std::string geo = folder.file("plate.geo", plate_geo);
  gmsh_convert(geo, folder / "plate.msh", 0.01, 2);
  for (const std::string name : {"plate.geo", "plate.msh"}) {
    CAPTURE(name);
    MeshRequest wish = plate_request(folder / name, name.ends_with(".msh"));
    // On a geometry the selection is made before there are solid cells, which would distinguish bores and pins.
    const std::string bore = name.ends_with(".msh") ? " (a bore)" : "";
    wish.surfaces = {{"bore",
                      {ShapeSelector(CylinderSelector{{0.05, 0.05, 0}, {0, 0, 1}, 0.031})},
                      "plate.yaml:7: interfaces.bore.surface"}};
    CHECK_THAT(
        import_message(wish),
        Catch::StartsWith(
            "plate.yaml:7: interfaces.bore.surface: no surface of the body lies on the cylinder with radius 0.031 m") &&
            Contains(
                "the nearest cylinders are: cylinder with radius 0.03 m about (0.05, 0.05, 0.01) m along (0, 0, 1)" +
                bore + "; cylinder with radius 0.02 m about (0.15, 0.05, 0.01) m along (0, 0, 1)" + bore));
    wish.surfaces = {selection("top", PlaneSelector{{0, 0, 0.021}, {0, 0, 1}})};
    CHECK_THAT(import_message(wish),
               Contains("the nearest planes are: plane through (") && Contains("0.02) m normal to (0, 0, 1)"));
    wish.surfaces = {selection("end", BoxSelector{{0.201, 0, 0}, {0.21, 0.1, 0.02}})};
    CHECK_THAT(import_message(wish), Contains("a surface must lie in the box as a whole; the nearest surfaces are: a "
                                              "plane from (0.2, 0, 0) m to (0.2, 0.1, 0.02) m"));
  }
}

TEST_CASE("the message says if a body has no cylinders") {
  const TemporaryFolder folder;
  MeshRequest wish = request(folder.file("box.geo", "SetFactory(\"OpenCASCADE\"); Box(1) = {0,0,0, 1,1,1};"));
  wish.size = 0.5;
  wish.surfaces = {selection("bore", CylinderSelector{{0, 0, 0}, {0, 0, 1}, 0.5})};
  CHECK_THAT(import_message(wish), Contains("it has no cylinders"));
}

TEST_CASE("the end face of a coarse shaft, whose nodes all lie on the rim, does not belong to the cylinder") {
  // The shaft is an octagonal prism with eight corners on the circle; its end faces are triangulated without inner
  // nodes.
  Eigen::Matrix3Xd points(3, 16);
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 2; ++k)
      points.col(i + 8 * k) << std::cos(i * std::numbers::pi / 4), std::sin(i * std::numbers::pi / 4), k;
  BodySurface surface;
  for (int i = 1; i < 7; ++i) {
    surface.sides.push_back({0, i + 1, i});
    surface.sides.push_back({8, 8 + i, 9 + i});
  }
  for (int i = 0; i < 8; ++i) {
    const int j = (i + 1) % 8;
    surface.sides.push_back({i, j, j + 8});
    surface.sides.push_back({i, j + 8, i + 8});
  }
  const std::vector<int> selected = select_sides(CylinderSelector{{0, 0, 0}, {0, 0, 1}, 1}, points, surface);
  CHECK(selected.size() == 16);
  CHECK(selected.front() == 12);
}

TEST_CASE("a box selects the triangles in it on a mesh, and whole surfaces on a geometry") {
  Box box;
  box.bricks = {4, 1, 1};
  const Mesh mesh = box_mesh(box);
  BodySurface surface;
  const CellBlock& triangles = *mesh.block(CellType::tri6);
  for (Eigen::Index i = 0; i < triangles.nodes.cols(); ++i) {
    surface.sides.push_back({triangles.nodes(0, i), triangles.nodes(1, i), triangles.nodes(2, i)});
    surface.entities.push_back(1);
  }
  // The box contains half of the upper face, which has two bricks and four triangles.
  const BoxSelector half{{-0.1, -0.1, 1}, {0.5, 1.1, 1}};
  CHECK(select_sides(half, mesh.points, surface).size() == 4);
  surface.geometry = true;
  CHECK_THROWS(select_sides(half, mesh.points, surface));
}
