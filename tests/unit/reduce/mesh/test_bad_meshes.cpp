// Tests of the messages about a geometry or mesh that cannot be reduced.
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "import_support.hpp"
#include <catch2/catch.hpp>
#include <fcntl.h>
#include <unistd.h>

#include "reduce/common/error.hpp"
#include "reduce/common/progress.hpp"
#include "reduce/mesh/checks.hpp"
#include "reduce/mesh/import.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::reduce;
using namespace bielle::test;
using Catch::Contains;
using Catch::StartsWith;

namespace {

const std::vector<std::string> corners = {"0 0 0", "1 0 0", "0 1 0", "0 0 1"};

// Returns the message about a mesh that is written as text, with the key in a body file.
std::string message_for(const std::string& text, const std::string& name = "body.msh") {
  const TemporaryFolder folder;
  MeshRequest wish = request(folder.file(name, text));
  wish.subject = "geometry";
  return import_message(wish);
}

MeshRequest small_box(const TemporaryFolder& folder, const std::string& more = "") {
  MeshRequest wish = request(folder.file("box.geo", "SetFactory(\"OpenCASCADE\"); Box(1) = {0,0,0, 1,1,1};\n" + more));
  wish.size = 0.5;
  wish.subject = "geometry";
  wish.mesh_subject = "mesh";
  return wish;
}

const std::string groups_geo =
    "Physical Volume(\"solid\") = {1}; Physical Surface(\"crown\") = {1}; Physical Surface(\"floor\") = {2};\n";

}  // namespace

TEST_CASE("an inverted element is named by its number in the file and its place") {
  CHECK_THAT(message_for(msh({"0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 1 1"}, {"4 2 1 1 1 2 3 4", "4 2 1 1 2 3 5 4"})),
             StartsWith("geometry: 1 of 2 elements is inverted (negative volume); the first is element 2 "
                        "at (0.5, 0.5, 0.5) m"));
}

TEST_CASE("a mesh whose elements are all inverted is mirrored") {
  CHECK_THAT(
      message_for(msh(corners, {"4 2 1 1 2 1 3 4"})),
      Contains(
          "every element is inverted (negative volume): the mesh is mirrored, or its nodes are ordered otherwise"));
}

TEST_CASE("a flat element is named") {
  CHECK_THAT(
      message_for(msh({"0 0 0", "1 0 0", "0 1 0", "0 0 1", "0.2 0.2 0"}, {"4 2 1 1 1 2 3 4", "4 2 1 1 1 3 2 5"})),
      Contains("1 of 2 elements is degenerate (no volume); the first is element 2 at"));
}

TEST_CASE("the message about a body in pieces describes them, and whether they touch") {
  const std::vector<std::string> apart = {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "4 0 0", "6 0 0", "4 2 0", "4 0 2"};
  CHECK_THAT(
      message_for(msh(apart, {"4 2 1 1 1 2 3 4", "4 2 1 1 5 6 7 8"})),
      Contains("the body is in 2 pieces that share no nodes: 1 element with 1.33 m^3 from (4, 0, 0) m to (6, 2, 2) m; "
               "1 element with 0.167 m^3 from (0, 0, 0) m to (1, 1, 1) m; join them"));
  const std::vector<std::string> touching = {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 0 0", "0 1 0", "0 0 1", "1 1 1"};
  CHECK_THAT(message_for(msh(touching, {"4 2 1 1 1 2 3 4", "4 2 1 1 5 6 7 8"})),
             Contains("in 2 pieces") && Contains("3 pairs of nodes at the same place: merge the nodes"));
}

TEST_CASE("coincident nodes within one piece are reported as a crack") {
  // Two bricks share only the lower half of the nodes of their common face; the other nodes exist twice.
  Mesh mesh = box_mesh({{2, 1, 1}, {2, 2, 2}, false});
  const CellBlock solids = mesh.blocks.front();
  int split = -1;
  for (int node = 0; node < mesh.point_count(); ++node)
    if ((mesh.points.col(node) - Eigen::Vector3d(1, 0.5, 1)).norm() < 1e-12) split = node;
  REQUIRE(split >= 0);
  mesh.points.conservativeResize(3, mesh.point_count() + 1);
  mesh.points.col(mesh.point_count() - 1) = mesh.points.col(split);
  for (CellBlock& block : mesh.blocks)
    for (Eigen::Index e = 0; e < block.nodes.cols(); ++e) {
      double x = 0;
      for (int node : block.nodes.col(e)) x += mesh.points(0, node) / static_cast<double>(block.nodes.rows());
      for (int& node : block.nodes.col(e))
        if (node == split && x > 1) node = static_cast<int>(mesh.point_count()) - 1;
    }
  CHECK_NOTHROW(check_connected(mesh));
  const CoincidentNodes found = coincident_nodes(mesh, FaceTable(mesh));
  CHECK(found.pairs == 1);
  CHECK((found.place - Eigen::Vector3d(1, 0.5, 1)).norm() < 1e-12);
  const Mesh sound = box_mesh({{2, 1, 1}, {2, 2, 2}, false});
  CHECK(coincident_nodes(sound, FaceTable(sound)).pairs == 0);
}

TEST_CASE("parts that are connected by an edge or a node only give a warning") {
  // Two tetrahedra with a common edge.
  Mesh mesh;
  mesh.points.resize(3, 6);
  mesh.points.col(0) << 0, 0, 0;
  mesh.points.col(1) << 1, 0, 0;
  mesh.points.col(2) << 0, 1, 0;
  mesh.points.col(3) << 0, 0, 1;
  mesh.points.col(4) << 0, -1, 0;
  mesh.points.col(5) << 0, 0, -1;
  Eigen::MatrixXi cells(4, 2);
  cells << 0, 0, 1, 1, 2, 4, 3, 5;
  mesh.blocks.push_back({CellType::tet4, cells});
  CHECK_NOTHROW(check_elements(mesh, {}));
  CHECK_NOTHROW(check_connected(mesh));
  CHECK_THAT(loose_joints(mesh, FaceTable(mesh)),
             StartsWith("2 parts of the body are connected by single nodes or edges only, about which they can turn: "
                        "1 element with 0.167 m^3 from"));
  CHECK(
      loose_joints(box_mesh({{1, 1, 1}, {2, 2, 2}, true}), FaceTable(box_mesh({{1, 1, 1}, {2, 2, 2}, true}))).empty());
}

TEST_CASE("wedges of order 1 give a warning, which counts single layers") {
  // Two wedges are on top of each other, and a third one is next to the upper one.
  Mesh mesh;
  mesh.points.resize(3, 11);
  for (int layer = 0; layer < 3; ++layer) {
    mesh.points.col(3 * layer) << 0, 0, layer;
    mesh.points.col(3 * layer + 1) << 1, 0, layer;
    mesh.points.col(3 * layer + 2) << 0, 1, layer;
  }
  mesh.points.col(9) << 1, 1, 1;
  mesh.points.col(10) << 1, 1, 2;
  Eigen::MatrixXi cells(6, 2);
  cells << 0, 3, 1, 4, 2, 5, 3, 6, 4, 7, 5, 8;
  mesh.blocks.push_back({CellType::wedge6, cells});
  CHECK(stiff_wedges(mesh, FaceTable(mesh)) ==
        "2 of 2 elements are wedge6, which are far too stiff in bending: use wedge15, or hexahedra");
  Eigen::MatrixXi more(6, 3);
  more << cells, (Eigen::VectorXi(6) << 4, 9, 5, 7, 10, 8).finished();
  mesh.blocks.front().nodes = more;
  CHECK(
      stiff_wedges(mesh, FaceTable(mesh)) ==
      "3 of 3 elements are wedge6 (1 as the only layer between two surfaces), which are far too stiff in bending: use "
      "wedge15, or hexahedra");
  const Mesh box = box_mesh({{1, 1, 1}, {1, 1, 1}, false});
  CHECK(stiff_wedges(box, FaceTable(box)).empty());
}

TEST_CASE("duplicate cells are refused, in any order of their nodes") {
  const std::vector<std::string> five = {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 1 1"};
  CHECK_THAT(
      message_for(msh(corners, {"4 2 1 1 1 2 3 4", "4 2 1 1 2 3 1 4", "4 2 1 1 2 1 3 4"})),
      StartsWith("geometry: 2 of 3 elements have the same corners as another one (the first: elements 1 and 2 at "
                 "(0.25, 0.25, 0.25) m): a part of the mesh is in the file more than once; keep one of each"));
  CHECK_THAT(
      message_for(msh(five, {"4 2 1 1 1 2 3 4", "4 2 1 1 2 5 3 4", "4 2 1 1 3 2 5 4"})),
      StartsWith("geometry: 1 of 3 elements has the same corners as another one (the first: elements 2 and 3 at") &&
          Contains("this cell is in the file more than once"));
  CHECK_THAT(message_for(msh(five, {"4 2 1 1 1 2 3 4", "4 2 1 1 2 5 3 4", "4 2 1 1 1 2 3 4", "4 2 1 1 2 5 3 4"})),
             StartsWith("geometry: 2 of 4 elements have") && Contains("elements 1 and 3 at") &&
                 Contains("the whole mesh is in the file more than once"));
}

TEST_CASE("cells that overlap with common nodes are refused") {
  // Two tetrahedra of different heights on the same side of one triangle; three on one triangle.
  const std::vector<std::string> points = {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "0 0 2", "0 0 -1"};
  CHECK_THAT(
      message_for(msh(points, {"4 2 1 1 1 2 3 4", "4 2 1 1 1 2 3 5"})),
      Contains("1 common face has both cells on the same side: cells overlap, the first are elements 1 and 2 at"));
  CHECK_THAT(message_for(msh(points, {"4 2 1 1 1 2 3 4", "4 2 1 1 1 2 3 5", "4 2 1 1 2 1 3 6"})),
             Contains("three or more cells share the face at (") && Contains("m: cells overlap"));
}

TEST_CASE("a tetrahedron on the nodes of a hexahedron is refused, though they share no face") {
  const std::vector<std::string> cube = {"0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1"};
  CHECK_THAT(
      message_for(msh(cube, {"5 2 1 1 1 2 3 4 5 6 7 8", "4 2 1 1 1 2 3 6"})),
      Contains("the body is in 2 pieces that share no faces") && Contains("the pieces overlap, elements 1 and 2 at"));
}

TEST_CASE("the message about overlapping pieces says so") {
  const std::vector<std::string> twice = {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "0 0 0", "1 0 0", "0 1 0", "0 0 1"};
  CHECK_THAT(
      message_for(msh(twice, {"4 2 1 1 1 2 3 4", "4 2 1 1 6 7 5 8"})),
      Contains("the body is in 2 pieces") &&
          Contains("1 of 2 elements lies on another one with nodes of its own (the first: elements 1 and 2 at") &&
          !Contains("merge the nodes"));
  const std::vector<std::string> crossing = {"0 0 0",     "1 0 0",     "0 1 0",     "0 0 1",
                                             ".1 .1 .05", "1.1 .1 .1", ".1 1.1 .1", ".1 .1 1.1"};
  CHECK_THAT(message_for(msh(crossing, {"4 2 1 1 1 2 3 4", "4 2 1 1 5 6 7 8"})),
             Contains("the pieces overlap, elements 1 and 2 at (0.25, 0.25, 0.25) m for example") &&
                 !Contains("merge the nodes"));
  // The bounding box of one piece contains the other, which is in a corner outside of the tetrahedron.
  const std::vector<std::string> apart = {"0 0 0",    "1 0 0",   "0 1 0",   "0 0 1",
                                          ".9 .9 .9", "1 .9 .9", ".9 1 .9", ".9 .9 1"};
  CHECK_THAT(message_for(msh(apart, {"4 2 1 1 1 2 3 4", "4 2 1 1 5 6 7 8"})),
             Contains("share no nodes") && !Contains("overlap"));
}

TEST_CASE("the message about cells of other types lists the supported ones") {
  std::vector<std::string> points;
  for (int i = 0; i < 18; ++i) points.push_back(std::to_string(i % 3) + " " + std::to_string(i / 3) + " 0");
  CHECK_THAT(message_for(msh(points, {"13 2 1 1 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18"})),
             Contains("holds 1 cell of type 'Prism 18', which is not supported; supported are tetrahedra with 4 or 10 "
                      "nodes, hexahedra with 8, 20 or 27 nodes, wedges (prisms) with 6 or 15 nodes, pyramids with 5 "
                      "or 13 nodes"));
  CHECK_THAT(message_for(msh(points, {"14 2 1 1 1 2 3 4 5 6 7 8 9 10 11 12 13 14"})),
             Contains("holds 1 cell of type 'Pyramid 14', which is not supported"));
}

TEST_CASE("a surface mesh and a mesh without cells are refused") {
  CHECK_THAT(message_for(msh(corners, {"2 2 1 1 1 2 3"})),
             Contains("holds a surface mesh only (1 cell); a body needs tetrahedra"));
  CHECK_THAT(message_for(msh(corners, {"15 2 1 1 1"})), Contains("holds no cells"));
}

TEST_CASE("linear and quadratic tetrahedra do not mix") {
  const std::vector<std::string> points = {"0 0 0",  "1 0 0",  "0 1 0",   "0 0 1",   ".5 0 0", ".5 .5 0",
                                           "0 .5 0", "0 0 .5", "0 .5 .5", ".5 0 .5", "1 1 1"};
  CHECK_THAT(message_for(msh(points, {"11 2 1 1 1 2 3 4 5 6 7 8 9 10", "4 2 1 1 2 3 4 11"})),
             Contains("mixes tetrahedra with 4 and with 10 nodes"));
}

TEST_CASE(
    "quadrilaterals that are not faces, other surface cells, and triangles of two orders on one surface are refused") {
  const std::vector<std::string> cube = {"0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1"};
  CHECK_THAT(message_for(msh(cube, {"4 2 1 1 1 2 4 5", "3 2 9 1 1 2 3 4"}, {"2 9 \"skin\""})),
             Contains("surface group 'skin' holds a quadrilateral that is no face of a solid cell"));
  CHECK_THAT(
      message_for(
          msh({"0 0 0", "3 0 0", "0 3 0", "0 0 3", "1 0 0", "2 0 0", "2 1 0", "1 2 0", "0 2 0", "0 1 0", "1 1 0"},
              {"4 2 1 1 1 2 3 4", "21 2 9 1 1 2 3 5 6 7 8 9 10 11"})),
      Contains("holds 1 surface cell of type 'Triangle 10', which is not supported; supported are triangles with "
               "3 or 6 nodes, quadrilaterals with 4, 8 or 9 nodes"));
  const std::vector<std::string> points = {"0 0 0",   "1 0 0",  "0 1 0",  "0 0 1",   ".5 0 0",
                                           ".5 .5 0", "0 .5 0", "0 0 .5", "0 .5 .5", ".5 0 .5"};
  CHECK_THAT(message_for(msh(points, {"11 2 1 1 1 2 3 4 5 6 7 8 9 10", "2 2 9 1 1 2 3", "9 2 9 1 1 3 4 7 9 8"})),
             Contains("mixes triangles with 3 and with 6 nodes on one surface"));
}

TEST_CASE("an element with a missing node is refused") {
  CHECK_THAT(message_for(msh(corners, {"4 2 1 1 1 2 3 4", "4 2 1 1 1 2 3 77"})),
             StartsWith("geometry: '") && Contains("cannot be read"));
}

TEST_CASE("a triangle in a group that is not a face of a solid is refused") {
  const std::vector<std::string> points = {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "2 2 2"};
  CHECK_THAT(message_for(msh(points, {"4 2 1 1 1 2 3 4", "2 2 9 1 1 2 5"}, {"2 9 \"skin\""})),
             Contains("surface group 'skin' holds a triangle that is no face of a solid cell"));
}

TEST_CASE("a linear triangle on a quadratic solid becomes a face with mid-side nodes") {
  const TemporaryFolder folder;
  const std::vector<std::string> points = {"0 0 0",   "1 0 0",  "0 1 0",  "0 0 1",   ".5 0 0",
                                           ".5 .5 0", "0 .5 0", "0 0 .5", "0 .5 .5", ".5 0 .5"};
  const Mesh mesh = import(request(
      folder.file("one.msh", msh(points, {"11 2 1 1 1 2 3 4 5 6 7 8 9 10", "2 2 9 1 1 2 3"}, {"2 9 \"base\""}))));
  CHECK(mesh.groups.at("base").nodes == std::vector<int>{0, 1, 2, 4, 5, 6});
}

TEST_CASE("files that are missing, empty or of another kind are named") {
  const TemporaryFolder folder;
  folder.file("conrod.geo", "");
  CHECK_THAT(import_message(request(folder / "conord.geo")),
             Contains("conord.geo' does not exist; did you mean 'conrod.geo'?"));
  CHECK_THAT(import_message(request(folder / "conrod.geo")), Contains("is empty"));
  CHECK_THAT(import_message(request(folder.path())), Contains("is not a file"));
  CHECK_THAT(message_for("this is no mesh\n"), StartsWith("geometry: '") && Contains("cannot be read"));
  CHECK_THAT(message_for("this is no geometry\n", "body.step"),
             StartsWith("geometry: '") && Contains("cannot be read"));
  CHECK_THAT(message_for("this is no geometry\n", "body.brep"),
             StartsWith("geometry: '") && Contains("cannot be read"));
  CHECK_THAT(message_for("Point(1) = {0, 0;\n", "body.geo"), StartsWith("geometry: '") && Contains("line 1"));
  CHECK_THAT(message_for("-1\nno universal file\n", "body.unv"),
             StartsWith("geometry: '") && Contains("cannot be read"));
  CHECK_THAT(message_for("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n7\n1 0 0 0\n"), StartsWith("geometry: '"));
}

TEST_CASE("an import succeeds after a failed one") {
  const TemporaryFolder folder;
  CHECK_THAT(message_for("Point(1) = {0, 0;\n", "body.geo"), Contains("line 1"));
  CHECK(import(small_box(folder)).solid_count() > 0);
}

TEST_CASE("a geometry needs volumes, and a mesh size unless it defines one") {
  const TemporaryFolder folder;
  MeshRequest flat = request(folder.file("flat.geo", "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0,0,0, 1,1};"));
  CHECK_THAT(import_message(flat), Contains("holds no volume: a body is a solid"));
  MeshRequest box = small_box(folder);
  gmsh_convert(box.path, folder / "box.step", 1, 1);
  box.path = folder / "box.step";
  box.size.reset();
  CHECK_THAT(import_message(box),
             StartsWith("geometry: ") && Contains("say how fine to mesh it, e.g. mesh: {size: 3e-3}"));
}

TEST_CASE("a size or an order is refused for a mesh") {
  const TemporaryFolder folder;
  MeshRequest wish = request(folder.file("one.msh", msh(corners, {"4 2 1 1 1 2 3 4"})));
  wish.mesh_subject = "mesh";
  wish.size = 0.1;
  CHECK_THAT(import_message(wish), StartsWith("mesh: ") && Contains("is a mesh already: remove this key"));
  wish.size.reset();
  wish.order = 2;
  CHECK_THAT(import_message(wish), Contains("is a mesh already"));
}

TEST_CASE("the message about an unknown group suggests the nearest one, before meshing") {
  const TemporaryFolder folder;
  MeshRequest wish = small_box(folder, groups_geo);
  wish.surfaces = {{"crwon", {std::string("crwon")}, "loads.gas.surface"}};
  CHECK_THAT(import_message(wish),
             StartsWith("loads.gas.surface: 'crwon' is not a physical surface of the geometry; did you mean 'crown'?"));
  wish.surfaces = {{"solid", {std::string("solid")}, "loads.gas.surface"}};
  CHECK_THAT(import_message(wish), Contains("'solid' is a physical volume of the geometry, but a surface is needed"));
  wish.surfaces.clear();
  wish.volumes = {{"sloid", "regions.sloid"}};
  CHECK_THAT(import_message(wish),
             StartsWith("regions.sloid: 'sloid' is not a physical volume") && Contains("did you mean 'solid'?"));
  wish = small_box(folder);
  wish.volumes = {{"solid", "regions.solid"}};
  CHECK_THAT(import_message(wish), Contains("it has no physical volumes: use all"));
  wish.volumes.clear();
  wish.surfaces = {{"crown", {std::string("crown")}, "loads.gas.surface"}};
  CHECK_THAT(import_message(wish),
             Contains("it has no physical surfaces; select by shape: {cylinder: {point, axis, radius}}"));
}

TEST_CASE("a physical surface without triangles is refused when it is used") {
  const TemporaryFolder folder;
  // In this file of format 4.1, surface 5 is an entity and belongs to group 9, but has no cells.
  MeshRequest wish =
      request(folder.file("one.msh",
                          "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 9 \"empty\"\n$EndPhysicalNames\n"
                          "$Entities\n0 0 1 1\n5 0 0 0 1 1 1 1 9 0\n1 0 0 0 1 1 1 0 1 5\n$EndEntities\n"
                          "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n"
                          "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n"));
  CHECK(import(wish).solid_count() == 1);
  wish.surfaces = {{"empty", {std::string("empty")}, "interfaces.end.surface"}};
  CHECK_THAT(import_message(wish), StartsWith("interfaces.end.surface: the physical surface 'empty' is empty"));
}

TEST_CASE("the message about an unknown unit of length lists the known ones") {
  const TemporaryFolder folder;
  MeshRequest wish = small_box(folder);
  wish.length_unit = "mn";
  wish.length_unit_subject = "length_unit";
  CHECK_THAT(import_message(wish), StartsWith("length_unit: 'mn' is not a unit of length"));
}

TEST_CASE("a body of more than 150 m or less than 1 mm gives a warning") {
  CHECK(implausible_size(box_mesh({{1, 1, 1}, {1, 1, 1}, false})).empty());
  CHECK_THAT(implausible_size(box_mesh({{2000, 1, 1}, {1, 1, 1}, false})),
             Contains("2e+03 m long: is length_unit right?"));
  CHECK_THAT(implausible_size(box_mesh({{2e-4, 1e-4, 1e-4}, {1, 1, 1}, false})), Contains("0.0002 m long"));
}

TEST_CASE("gmsh and OpenCASCADE print nothing on standard output") {
  const TemporaryFolder folder;
  std::cout.flush();
  std::fflush(stdout);
  const int saved = dup(STDOUT_FILENO);
  const int file = open((folder / "out").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(file, STDOUT_FILENO);
  MeshRequest wish = request(std::string(BIELLE_SOURCE_DIR) + "/meshes/conrod.step");
  wish.size = 0.01;
  import(wish);
  std::cout.flush();
  std::fflush(stdout);
  dup2(saved, STDOUT_FILENO);
  close(saved);
  close(file);
  CHECK(std::filesystem::file_size(folder / "out") == 0);
}

TEST_CASE("the quality of a regular and of a right-angled tetrahedron is the closed form") {
  Mesh mesh;
  mesh.points.resize(3, 4);
  mesh.points << 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1, 1;
  mesh.blocks.push_back({CellType::tet4, Eigen::Vector4i(0, 2, 1, 3)});
  const MeshQuality regular = mesh_quality(mesh);
  CHECK(regular.least_scaled_jacobian == Approx(1).margin(1e-14));
  CHECK(regular.shortest_edge == Approx(std::sqrt(8)).margin(1e-14));
  mesh.points << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  mesh.blocks.front().nodes = Eigen::Vector4i(0, 1, 2, 3);
  // The least value, at a corner of the large face, is sqrt(2) * 1 / (1 * sqrt(2) * sqrt(2)).
  CHECK(mesh_quality(mesh).least_scaled_jacobian == Approx(std::sqrt(0.5)).margin(1e-14));
}
