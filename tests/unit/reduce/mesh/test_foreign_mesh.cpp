// Tests of meshes of other programs, which are read by the converter.
#include <cstdlib>

#include "import_support.hpp"
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/mesh/foreign_mesh.hpp"
#include "reduce/mesh/measures.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle;
using namespace bielle::reduce;
using namespace bielle::test;
using Catch::Contains;

namespace {

// Two tetrahedra in mm, as Abaqus writes them, with an element set and a node set on their common plane y = 0.
const char* const abaqus =
    "*NODE\n1, 0, 0, 0\n2, 1000, 0, 0\n3, 0, 0, 1000\n4, 0, 1000, 0\n5, 1000, 1000, 1000\n"
    "*ELEMENT, TYPE=C3D4, ELSET=BODY\n1, 1, 3, 2, 4\n2, 2, 3, 5, 4\n*NSET, NSET=BASE\n1, 2, 3\n";

}  // namespace

TEST_CASE("an Abaqus mesh is imported in metres with its sets") {
  const TemporaryFolder folder;
  MeshRequest wish = request(folder.file("two.inp", abaqus));
  wish.length_unit = "mm";
  const Mesh mesh = import(wish);
  CHECK(mesh.solid_count() == 2);
  CHECK(mesh_volume(mesh) ==
        Approx(1.0 / 6 + 2.0 / 6).epsilon(1e-12));  // a corner of a cube, and the regular tetrahedron in it
  CHECK(mesh.groups.at("BODY").nodes.size() == 5);
  CHECK((area_vector(mesh, "BASE") - Eigen::Vector3d(0, -0.5, 0)).norm() < 1e-15);
}

TEST_CASE("the converter's message about a wrong file is shown to the user") {
  const TemporaryFolder folder;
  MeshRequest wish = request(folder.file("bad.vtu", "no mesh at all"));
  wish.subject = "geometry";
  CHECK_THAT(import_message(wish), Catch::StartsWith("geometry: ") && Contains("bad.vtu"));
}

TEST_CASE("the message about a missing converter names it") {
  const TemporaryFolder folder;
  const MeshRequest wish = request(folder.file("two.inp", abaqus));
  setenv("BIELLE_TOOLS", folder.path().c_str(), 1);
  const std::string message = message_of<ComputationError>([&] { import(wish); });
  unsetenv("BIELLE_TOOLS");
  CHECK_THAT(message, Catch::StartsWith("BIELLE_TOOLS is '") && Contains("there is no convert_mesh.py in it"));
}

TEST_CASE("files that gmsh reads without loss are read by gmsh, with extensions in any case") {
  CHECK(gmsh_reads("rod.STEP"));
  CHECK(gmsh_reads("rod.v2.msh"));
  CHECK_FALSE(gmsh_reads("rod.bdf"));
  CHECK_FALSE(gmsh_reads("rod"));
}
