// Tests of the solids of assemblies: selection by number and name, gluing, names, lists.
#include <regex>

#include "import_support.hpp"
#include "step_assembly.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "reduce/common/progress.hpp"
#include "reduce/mesh/describe.hpp"
#include "reduce/mesh/measures.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::reduce;
using namespace bielle::test;
using Catch::Contains;
using Catch::Matchers::WithinRel;

namespace {

// Boxes with lengths of 2, 1 and 1 m along x, the last of which is separate. The first one is a physical volume with a
// physical surface.
const char* const boxes =
    "SetFactory(\"OpenCASCADE\");\n"
    "Box(1) = {0, 0, 0, 2, 1, 1}; Box(2) = {2, 0, 0, 1, 1, 1}; Box(3) = {4, 0, 0, 1, 1, 1};\n";

MeshRequest boxes_request(const std::string& path, const std::vector<std::string>& solids) {
  MeshRequest result = request(path);
  result.size = 0.5;
  for (const std::string& name : solids) result.solids.push_back({name, "volumes"});
  return result;
}

double volume_of_group(const Mesh& mesh, const std::string& name) {
  double sum = 0;
  for (const GroupPart& part : mesh.groups.at(name).parts) {
    Mesh alone;
    alone.points = mesh.points;
    CellBlock block{part.type, Eigen::MatrixXi(node_count(part.type), part.cells.size())};
    for (std::size_t k = 0; k < part.cells.size(); ++k)
      block.nodes.col(k) = mesh.block(part.type)->nodes.col(part.cells[k]);
    alone.blocks.push_back(block);
    sum += mesh_volume(alone);
  }
  return sum;
}

}  // namespace

TEST_CASE("one of several solids is selected by its number") {
  const TemporaryFolder folder;
  const std::string path = folder.file("boxes.geo", boxes);
  CHECK_THAT(mesh_volume(import(boxes_request(path, {"1"}))), WithinRel(2.0, 1e-12));
  const Mesh last = import(boxes_request(path, {"3"}));
  CHECK_THAT(mesh_volume(last), WithinRel(1.0, 1e-12));
  CHECK(last.points.row(0).minCoeff() > 4 - 1e-12);
  CHECK_THAT(mesh_volume(import(boxes_request(path, {"volume_2"}))), WithinRel(1.0, 1e-12));
}

TEST_CASE("solids of gmsh's own kernel can be selected, but not glued") {
  const TemporaryFolder folder;
  const std::string path = folder.file("boxes.geo",
                                       "Point(1) = {0, 0, 0}; Point(2) = {0, 1, 0}; Line(1) = {1, 2};\n"
                                       "s[] = Extrude {0, 0, 1} {Line{1};}; v[] = Extrude {2, 0, 0} {Surface{s[1]};};\n"
                                       "far[] = Translate {5, 0, 0} {Duplicata{Volume{v[1]};}};\n"
                                       "Physical Volume(\"far\") = far[]; Physical Volume(\"near\") = v[1];\n");
  MeshRequest wanted = boxes_request(path, {"far"});
  const Mesh mesh = import(wanted);
  CHECK_THAT(mesh_volume(mesh), WithinRel(2.0, 1e-12));
  CHECK(mesh.points.row(0).minCoeff() > 5 - 1e-12);
  wanted.solids.clear();
  CHECK_THAT(import_message(wanted), Contains("the body is in 2 pieces that share no faces") &&
                                         Contains("let them use common surfaces, or select one by `volume: "));
  wanted.glue = true;
  CHECK_THAT(import_message(wanted), Contains("of gmsh's own kernel, whose solids cannot be glued"));
}

TEST_CASE("solids that touch are glued, and each keeps its name for regions") {
  const TemporaryFolder folder;
  MeshRequest wanted = boxes_request(folder.file("boxes.geo", boxes), {"1", "2"});
  CHECK_THAT(import_message(wanted), Contains("in 2 pieces that share no faces, solids of") &&
                                         Contains("volume 1; volume 2; if they touch, `glue: true` joins them"));
  wanted.glue = true;
  wanted.volumes = {{"volume_1", "regions.volume_1"}, {"volume_2", "regions.volume_2"}};
  const Mesh mesh = import(wanted);
  CHECK_THAT(mesh_volume(mesh), WithinRel(3.0, 1e-12));
  CHECK_THAT(volume_of_group(mesh, "volume_1"), WithinRel(2.0, 1e-12));
  CHECK_THAT(volume_of_group(mesh, "volume_2"), WithinRel(1.0, 1e-12));
  wanted.volumes = {{"volume_3", "regions.volume_3"}};
  CHECK_THAT(import_message(wanted),
             Contains("'volume_3' is not a physical volume of the geometry") && Contains("did you mean 'volume_"));
}

TEST_CASE("glue divides faces that touch partly, and joins solids in a row") {
  const TemporaryFolder folder;
  // Two blocks stand on a plate; each covers a part of its face.
  MeshRequest wanted = boxes_request(folder.file("blocks.geo",
                                                 "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 4, 1, 0.5};\n"
                                                 "Box(2) = {0.5, 0.2, 0.5, 1, 0.5, 1}; Box(3) = {3, 0, 0.5, 1, 1, 1};\n"
                                                 "Physical Surface(\"under\") = Surface In BoundingBox "
                                                 "{-1, -1, -0.1, 5, 2, 0.1};\n"),
                                     {});
  wanted.glue = true;
  wanted.surfaces = {selection("under", "under")};
  const Mesh mesh = import(wanted);
  CHECK_THAT(mesh_volume(mesh), WithinRel(2 + 0.5 + 1, 1e-12));
  CHECK_THAT(area_vector(mesh, "under").z(), WithinRel(-4.0, 1e-12));
}

TEST_CASE("solids remain separate pieces if those between them are not selected") {
  const TemporaryFolder folder;
  MeshRequest wanted = boxes_request(folder.file("boxes.geo", boxes), {});
  wanted.glue = true;
  CHECK_THAT(import_message(wanted), Contains("in 2 pieces that share no faces") &&
                                         Contains("volume 1, volume 2; volume 3; they do not touch: move them"));
}

TEST_CASE("solids that overlap are refused by name with their common volume") {
  const TemporaryFolder folder;
  MeshRequest wanted = boxes_request(
      folder.file("boxes.geo",
                  "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 2, 1, 1}; Box(2) = {1.9, 0, 0, 1, 1, 1};\n"
                  "Box(3) = {2.9, 0, 0, 1, 1, 1};\n"),
      {});
  wanted.glue = true;
  wanted.length_unit = "mm";
  wanted.size = 5e-4;
  CHECK_THAT(import_message(wanted),
             Contains("solids overlap: volume 1 and volume 2 by 1e-10 m^3, 10 % of the smaller one; solids that"));
  wanted.solids = {{"2", ""}, {"3", ""}};
  CHECK_THAT(mesh_volume(import(wanted)), WithinRel(2e-9, 1e-10));
  // A shaft in a block that has no bore, and the same solid twice.
  wanted = boxes_request(folder.file("shaft.geo",
                                     "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 2, 2, 2};\n"
                                     "Box(2) = {0.5, 0.5, 0.5, 1, 1, 1};\n"),
                         {});
  wanted.glue = true;
  CHECK_THAT(import_message(wanted), Contains("volume 1 and volume 2 by 1 m^3, 100 % of the smaller one"));
}

TEST_CASE("glue has nothing to do on a single solid") {
  const TemporaryFolder folder;
  MeshRequest wanted = boxes_request(folder.file("boxes.geo", boxes), {"2"});
  wanted.glue = true;
  CHECK_THAT(mesh_volume(import(wanted)), WithinRel(1.0, 1e-12));
}

TEST_CASE("numbers take precedence over physical volumes, which keep their other solids") {
  const TemporaryFolder folder;
  const std::string path =
      folder.file("boxes.geo", std::string(boxes) +
                                   "Physical Volume(\"pair\") = {1, 2}; Physical Volume(\"3\") = {1};\n"
                                   "Physical Volume(\"far\") = {3}; Physical Surface(\"end\") = Surface In BoundingBox "
                                   "{4.9, -1, -1, 5.1, 2, 2};\n");
  CHECK(import(boxes_request(path, {"3"})).points.row(0).minCoeff() > 4 - 1e-12);
  MeshRequest pair = boxes_request(path, {"pair"});
  pair.glue = true;
  CHECK_THAT(volume_of_group(import(pair), "pair"), WithinRel(3.0, 1e-12));
  CHECK_THAT(volume_of_group(import(boxes_request(path, {"2"})), "pair"), WithinRel(1.0, 1e-12));
  pair.volumes = {{"far", "regions.far"}};
  CHECK_THAT(import_message(pair), Contains("the physical volume 'far' belongs to none of the selected solids"));
  pair.volumes.clear();
  pair.surfaces = {selection("end", "end")};
  CHECK_THAT(import_message(pair), Contains("the physical surface 'end' belongs to none of the selected solids"));
}

TEST_CASE("messages about wrong selections of solids suggest the nearest names") {
  const TemporaryFolder folder;
  const std::string path = folder.file("boxes.geo", boxes);
  for (const char* number : {"0", "-1", "1.5", "4", "99999999999", "1e9"})
    CHECK_THAT(import_message(boxes_request(path, {number})),
               Contains(fmt::format("there is no volume {} in ", number)) && Contains("expected one of '1', '2', '3'"));
  CHECK_THAT(import_message(boxes_request(path, {"volume_4"})),
             Contains("'volume_4' is no solid, part or physical volume of ") && Contains("did you mean 'volume_"));
  CHECK_THAT(import_message(boxes_request(path, {"2", "2"})),
             Contains("volume 2 is selected twice, by '2' and by '2'"));
  CHECK_THAT(import_message(boxes_request(path, {"2", "volume_2"})),
             Contains("volume 2 is selected twice, by '2' and by 'volume_2'"));
}

TEST_CASE("surfaces by shape are found on the selected solids only") {
  const TemporaryFolder folder;
  const std::string path = folder.file("boxes.geo", boxes);
  MeshRequest wanted = boxes_request(path, {"1"});
  wanted.surfaces = {selection("side", ShapeSelector(PlaneSelector{{0, 0, 0}, {0, 1, 0}}))};
  CHECK_THAT(corner_area(import(wanted), "side"), WithinRel(2.0, 1e-12));
  wanted.surfaces = {selection("end", ShapeSelector(PlaneSelector{{5, 0, 0}, {1, 0, 0}}))};
  CHECK_THAT(import_message(wanted), Contains("no surface of the body lies on the plane"));
}

TEST_CASE("meshes have no solids to select or glue") {
  const TemporaryFolder folder;
  gmsh_convert(folder.file("box.geo", "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 2, 1, 1};\n"),
               folder / "box.msh", 0.5, 1);
  MeshRequest wanted = request(folder / "box.msh");
  wanted.solids = {{"1", "volume"}};
  CHECK_THAT(import_message(wanted), Contains("is a mesh, of which no solids can be selected"));
  wanted.solids.clear();
  wanted.glue = true;
  CHECK_THAT(import_message(wanted), Contains("is a mesh, whose parts cannot be glued"));
}

TEST_CASE("solids of a STEP assembly have the names of its products and instances") {
  const TemporaryFolder folder;
  const std::string path = step_assembly(folder);
  MeshRequest wanted = request(path);
  wanted.size = 0.005;
  wanted.solids = {{"arm", "volume"}};
  CHECK_THAT(mesh_volume(import(wanted)), WithinRel(1e-5, 1e-10));
  wanted.solids = {{"right", "volume"}};  // name of an instance
  const Mesh right = import(wanted);
  CHECK_THAT(mesh_volume(right), WithinRel(2e-6, 1e-10));
  CHECK(right.points.row(2).minCoeff() > 0.05 - 1e-9);
  wanted.solids = {{"amr", "volume"}};
  CHECK_THAT(import_message(wanted),
             Contains("'amr' is no solid, part or physical volume") && Contains("did you mean 'arm'?"));
  wanted.solids = {{"tip", "volume"}};  // both
  CHECK_THAT(import_message(wanted), Contains("the body is in 2 pieces"));
  wanted.solids = {{"arm", "volumes[1]"}, {"left/finger", "volumes[2]"}};
  wanted.glue = true;
  wanted.volumes = {{"arm", "regions.arm"}, {"finger", "regions.finger"}};
  const Mesh mesh = import(wanted);
  CHECK_THAT(volume_of_group(mesh, "arm"), WithinRel(1e-5, 1e-10));
  CHECK_THAT(volume_of_group(mesh, "finger"), WithinRel(2e-6, 1e-10));
  wanted.volumes.front().group = "fingr";
  CHECK_THAT(import_message(wanted), Contains("did you mean 'finger'?"));
}

TEST_CASE("an assembly is listed as a tree with the masses of its solids") {
  const TemporaryFolder folder;
  const std::string path = step_assembly(folder);
  Progress progress(true);
  const std::string text = describe_geometry(path, {}, progress, false, {{"arm", 7850}, {"left", 1000}});
  const std::size_t begin = text.find("volumes\n  "), end = text.find("surfaces\n  ");
  REQUIRE(begin < end);
  // The first part and the parts of the fingers are instances whose names gmsh chose.
  const std::string tree = std::regex_replace(text.substr(begin, end - begin), std::regex("\n( +)\\d+\n"), "\n$1*\n");
  CHECK(tree ==
        "volumes\n"
        "  gripper\n"
        "    *\n"
        "      volume 1: 'arm', 1e-05 m^3, 0.0785 kg, from (0, 0, 0) m to (0.1, 0.01, 0.01) m\n"
        "    left\n"
        "      finger\n"
        "        *\n"
        "          volume 2: 'tip', 2e-06 m^3, 0.002 kg, from (0.1, 0, 0) m to (0.12, 0.01, 0.01) m\n"
        "    right\n"
        "      finger\n"
        "        *\n"
        "          volume 3: 'tip', 2e-06 m^3, from (0.1, 0, 0.05) m to (0.12, 0.01, 0.06) m\n");
}
