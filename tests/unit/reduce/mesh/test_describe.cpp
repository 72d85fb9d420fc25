// Tests of `--list`: the contents of a geometry or mesh; its lines must select the surfaces that they describe.
#include <regex>

#include "import_support.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/describe.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::reduce;
using namespace bielle::test;
using Catch::Contains;

namespace {

std::string list(const std::string& path, const std::optional<std::string>& unit = {}) {
  Progress progress(true);
  return describe_geometry(path, unit, progress);
}

const std::string meshes = std::string(BIELLE_SOURCE_DIR) + "/meshes/";

}  // namespace

TEST_CASE("the list of the connecting rod in STEP has its unit, volume and bores, and the lines that select them") {
  const std::string text = list(meshes + "conrod.step");
  CHECK_THAT(text, Contains("a geometry; it says that its unit is mm"));
  CHECK_THAT(text, Contains("physical surfaces (for interfaces and loads): none; select by shape"));
  CHECK_THAT(text, Contains("m^3, from (-0.034, -0.034, -0.013) m to (0.2175, 0.034, 0.013) m"));
  // The bores have the area 2 pi r w: 0.00392071 and 0.00152053 m^2.
  CHECK_THAT(text, Contains("cylinder with radius 0.024 m about (0, 0, 0) m along (0, 0, 1), area 0.003921 m^2"));
  CHECK_THAT(text, Contains("surface: {cylinder: {point: [0, 0, 0], axis: [0, 0, 1], radius: 0.024}}"));
  CHECK_THAT(text, Contains("cylinder with radius 0.011 m about (0.2, 0, 0) m along (0, 0, 1), area 0.001521 m^2"));
  CHECK_THAT(text, Contains("surface: {cylinder: {point: [0.2, 0, 0], axis: [0, 0, 1], radius: 0.011}}"));
  CHECK_THAT(text, Contains("torus with radii"));
}

TEST_CASE("the list of the connecting rod in gmsh's language has its groups, and its unit if it is stated") {
  CHECK_THAT(list(meshes + "conrod.geo", "mm"),
             Contains("read in mm as length_unit says") && Contains("physical volumes (for regions): rod\n") &&
                 Contains("physical surfaces (for interfaces and loads): bore_big, bore_small\n") &&
                 Contains("radius 0.024 m") && Contains("; in bore_big"));
  CHECK_THAT(list(meshes + "conrod.geo"),
             Contains("it carries no unit: read in m (length_unit changes that)") && Contains("radius 24 m"));
}

TEST_CASE("a geometry of gmsh's own kernel is listed without volumes") {
  const TemporaryFolder folder;
  const std::string path = folder.file(
      "box.geo",
      "Point(1)={0,0,0}; Point(2)={1,0,0}; Point(3)={1,1,0}; Point(4)={0,1,0};\n"
      "Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1}; Curve Loop(1)={1:4}; Plane Surface(1)={1};\n"
      "Extrude{0,0,2}{Surface{1};}\n");
  CHECK_THAT(list(path),
             Contains("volume 1: from (0, 0, 0) m to (1, 1, 2) m\n") && Contains("plane normal to (0, 0, 1)\n"));
}

TEST_CASE("a mesh is listed with cells, groups and the shapes of its surface") {
  const TemporaryFolder folder;
  const std::string geo = folder.file(
      "pipe.geo",
      "SetFactory(\"OpenCASCADE\"); Cylinder(1) = {0,0,0, 0,0,.1, .05}; Cylinder(2) = {0,0,0, 0,0,.1, .02};\n"
      "BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };\n"
      "Physical Volume(\"pipe\") = {3}; Physical Surface(\"end\") = Surface In BoundingBox {-1,-1,.09, 1,1,1};\n");
  gmsh_convert(geo, folder / "pipe.msh", 0.01, 2);
  const std::string text = list(folder / "pipe.msh");
  CHECK_THAT(text, Contains(": a mesh; it carries no unit") && Contains("physical volumes (for regions): pipe\n") &&
                       Contains("Tetrahedron 10\n") && Contains("surface, divided at edges of more than 40 degrees") &&
                       Contains("cylinder with radius 0.05 m about (0, 0, 0.05) m along (0, 0, 1), area") &&
                       Contains("cylinder with radius 0.02 m about (0, 0, 0.05) m along (0, 0, 1) (a bore)") &&
                       Contains("; in end\n"));
}

TEST_CASE("a mesh of hexahedra is listed with cells, groups and the shapes of its surface") {
  const TemporaryFolder folder;
  const std::vector<std::string> cube = {"0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1"};
  const std::string text =
      list(folder.file("cube.msh", msh(cube, {"5 2 1 1 1 2 3 4 5 6 7 8", "3 2 9 1 1 4 3 2"}, {"2 9 \"base\""})));
  CHECK_THAT(text, Contains("1 Hexahedron 8\n") && Contains("8 nodes, 1 hex8, edges from 1 m to 1 m") &&
                       Contains("patch 6: plane normal to") && Contains("; in base\n"));
}

TEST_CASE("a mesh that cannot be reduced is listed, with the reason") {
  const TemporaryFolder folder;
  std::vector<std::string> points;
  for (int i = 0; i < 14; ++i) points.push_back(std::to_string(i % 3) + " " + std::to_string(i / 3) + " 0");
  CHECK_THAT(list(folder.file("pyramid.msh", msh(points, {"14 2 1 1 1 2 3 4 5 6 7 8 9 10 11 12 13 14"}))),
             Contains("1 Pyramid 14\n") && Contains("not usable as it is:") && Contains("supported are tetrahedra"));
  CHECK_THAT(message_of<InputError>([&] { list(folder / "nothing.step"); }), Contains("does not exist"));
}

TEST_CASE("every cylinder and plane line of a list selects its surface") {
  const TemporaryFolder folder;
  const std::string path = meshes + "conrod.step";
  const std::string text = list(path);
  const std::string n = R"(([-0-9.e]+))";
  const std::string v = "\\[" + n + ", " + n + ", " + n + "\\]";
  const std::regex cylinder("cylinder: \\{point: " + v + ", axis: " + v + ", radius: " + n),
      plane("plane: \\{point: " + v + ", normal: " + v);
  MeshRequest wish = request(path);
  wish.size = 0.008;
  wish.order = 1;
  const auto vector = [](const std::smatch& match, int first) {
    return Eigen::Vector3d(std::stod(match[first]), std::stod(match[first + 1]), std::stod(match[first + 2]));
  };
  for (auto it = std::sregex_iterator(text.begin(), text.end(), cylinder); it != std::sregex_iterator(); ++it)
    wish.surfaces.push_back(selection(fmt::format("cylinder {}", wish.surfaces.size()),
                                      CylinderSelector{vector(*it, 1), vector(*it, 4), std::stod((*it)[7])}));
  for (auto it = std::sregex_iterator(text.begin(), text.end(), plane); it != std::sregex_iterator(); ++it)
    wish.surfaces.push_back(
        selection(fmt::format("plane {}", wish.surfaces.size()), PlaneSelector{vector(*it, 1), vector(*it, 4)}));
  CHECK(wish.surfaces.size() > 30);
  const Mesh mesh = import(wish);
  CHECK(mesh.groups.size() == wish.surfaces.size() + 1);
}
