// Tests of meshes of hexahedra, wedges and pyramids: volumes, faces, groups, and messages about errors.
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "import_support.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <gmsh.h>

#include "reduce/common/error.hpp"
#include "reduce/mesh/checks.hpp"
#include "reduce/mesh/cut_mesh.hpp"
#include "reduce/mesh/faces.hpp"
#include "reduce/mesh/gmsh/session.hpp"
#include "reduce/mesh/jacobian.hpp"
#include "reduce/mesh/measures.hpp"
#include "reduce/mesh/selectors.hpp"
#include "reduce/mesh/straighten.hpp"
#include "reduce/mesh/wall_thickness.hpp"
#include "tests/support/cell_box.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::reduce;
using namespace bielle::test;
using Catch::Contains;
using Catch::StartsWith;

namespace test_cell_meshes {

const std::vector<CellType> types = {CellType::hex8,    CellType::hex20,    CellType::hex27,    CellType::wedge6,
                                     CellType::wedge15, CellType::pyramid5, CellType::pyramid13};

Mesh mesh_of(CellType type, const Eigen::Vector3d& size, const std::array<int, 3>& bricks,
             const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map = {}) {
  return cell_box(type, size, bricks, {}, map);
}

double volume_of_divergence(const Mesh& mesh, const FaceTable& faces) {
  // By Gauss' theorem 3 V is the sum of x . n dA over plane faces.
  double sum = 0;
  for (const int face : faces.boundary())
    sum += mesh.points.col(faces.corners(face)[0]).dot(area_vector(mesh.points, faces.corners(face)));
  return sum / 3;
}

// Numbers of boundary faces of a box of bricks: those normal to x and y, and those normal to z.
int boundary_count(CellType type, const std::array<int, 3>& n) {
  const bool wedge = vertex_count(type) == 6;
  return 2 * (n[0] * n[2] + n[1] * n[2]) + (wedge ? 4 : 2) * n[0] * n[1];
}

std::string message_for(const Mesh& mesh) {
  const TemporaryFolder folder;
  return import_message(request(folder.file("body.msh", as_msh(mesh))));
}

std::set<std::array<double, 3>> places(const Mesh& mesh, const std::string& group) {
  std::set<std::array<double, 3>> result;
  for (const int node : mesh.groups.at(group).nodes)
    result.insert({mesh.points(0, node), mesh.points(1, node), mesh.points(2, node)});
  return result;
}

TEST_CASE("a box of any type of cells has its volume, and faces that point outward") {
  const std::array<int, 3> bricks{3, 2, 2};
  for (const CellType type : types) {
    CAPTURE(cell_name(type));
    const Mesh mesh = mesh_of(type, {0.3, 0.2, 0.1}, bricks);
    CHECK(mesh_volume(mesh) == Approx(0.006).epsilon(1e-13));
    CHECK_NOTHROW(check_elements(mesh, {}));
    CHECK_NOTHROW(check_connected(mesh));
    const FaceTable faces(mesh);
    CHECK(loose_joints(mesh, faces).empty());
    CHECK(coincident_nodes(mesh, faces).pairs == 0);
    const std::vector<int> boundary = faces.boundary();
    CHECK(static_cast<int>(boundary.size()) == boundary_count(type, bricks));
    CHECK(volume_of_divergence(mesh, faces) == Approx(0.006).epsilon(1e-13));
    double area = 0;
    for (const int face : boundary) {
      const Corners corners = faces.corners(face);
      area += area_of(mesh.points, corners);
      Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      for (const int node : corners) middle += mesh.points.col(node) / corners.size();
      // All points of a box are on the inner side of each face.
      CHECK(area_vector(mesh.points, corners).dot(Eigen::Vector3d(0.15, 0.1, 0.05) - middle) < 0);
      CHECK(faces.nodes(face).size() == node_count(faces.type(face)));
      CHECK(faces.find(corners) == face);
    }
    CHECK(area == Approx(2 * (0.06 + 0.03 + 0.02)).epsilon(1e-13));
    CHECK(summary(mesh).find(fmt::format("{} {}", mesh.solid_count(), cell_name(type))) != std::string::npos);
  }
}

TEST_CASE("a file with cells of any type is imported with its groups") {
  const TemporaryFolder folder;
  for (const CellType type : types) {
    CAPTURE(cell_name(type));
    const Mesh whole = mesh_of(type, {0.3, 0.2, 0.1}, {3, 2, 2});
    MeshRequest wish = request(folder.file("body.msh", as_msh(whole)));
    wish.surfaces = {selection("plane", PlaneSelector{{0.3, 0, 0}, {1, 0, 0}}),
                     selection("top", PlaneSelector{{0, 0, 0.1}, {0, 0, 1}}), selection("physical", std::string("z0"))};
    const Mesh mesh = import(wish);
    // gmsh sorts the points by the groups in which they occur first.
    CHECK(mesh.point_count() == whole.point_count());
    CHECK(mesh.blocks.front().type == type);
    CHECK(mesh_volume(mesh) == Approx(0.006).epsilon(1e-13));
    for (const auto& [name, group] : whole.groups) {
      CHECK(places(mesh, name) == places(whole, name));
      if (group.dimension == 2) CHECK((area_vector(mesh, name) - area_vector(whole, name)).norm() < 1e-15);
    }
    CHECK((area_vector(mesh, "x0") - Eigen::Vector3d(-0.02, 0, 0)).norm() < 1e-15);
    CHECK(places(mesh, "plane") == places(whole, "x1"));
    CHECK(places(mesh, "top") == places(whole, "z1"));
    CHECK(places(mesh, "physical") == places(whole, "z0"));
  }
}

TEST_CASE("hexahedra and wedges of a universal file are read by gmsh") {
  const TemporaryFolder folder;
  for (const CellType type : {CellType::hex8, CellType::hex20, CellType::wedge6, CellType::wedge15}) {
    CAPTURE(cell_name(type));
    const Mesh whole = mesh_of(type, {1, 1, 1}, {2, 2, 1}, [](const Eigen::Vector3d& x) {
      return Eigen::Vector3d(x + Eigen::Vector3d(0.2 * x.y() * x.y(), 0.1 * x.z() * x.z(), 0));
    });
    const std::string path = folder.file("body.msh", as_msh(whole));
    {
      GmshSession session;
      session.read("test", [&] {
        gmsh::open(path);
        gmsh::write(folder / "body.unv");
      });
    }
    const Mesh mesh = import(request(folder / "body.unv"));
    CHECK(mesh.blocks.front().type == type);
    CHECK(mesh_volume(mesh) == Approx(mesh_volume(whole)).epsilon(1e-12));
  }
}

TEST_CASE("a surface of a wedge mesh may have triangles and quadrilaterals") {
  const TemporaryFolder folder;
  MeshRequest wish = request(folder.file("body.msh", as_msh(mesh_of(CellType::wedge15, {1, 1, 1}, {2, 2, 2}))));
  wish.surfaces = {{"corner", {PlaneSelector{{1, 0, 0}, {1, 0, 0}}, PlaneSelector{{0, 0, 1}, {0, 0, 1}}}, ""}};
  const Mesh mesh = import(wish);
  const Group& group = mesh.groups.at("corner");
  REQUIRE(group.parts.size() == 2);
  CHECK(group.parts[0].type == CellType::tri6);
  CHECK(group.parts[0].cells.size() == 8);
  CHECK(group.parts[1].type == CellType::quad8);
  CHECK(group.parts[1].cells.size() == 4);
  CHECK((area_vector(mesh, "corner") - Eigen::Vector3d(1, 0, 1)).norm() < 1e-14);
  CHECK(group.nodes.size() == 21 + 25 - 5);
}

TEST_CASE("an inverted cell of any type is named by its number in the file") {
  for (const CellType type : types) {
    CAPTURE(cell_name(type));
    Mesh mesh = mesh_of(type, {2, 2, 2}, {2, 2, 2});
    const int first_number = 1;  // the group of solid cells is the first one in the file
    // Cell 2 is inverted by an exchange of its base and its top; the base of a pyramid is reversed instead.
    CellBlock& solids = mesh.blocks.front();
    auto cell = solids.nodes.col(2);
    const int vertices = vertex_count(type);
    if (vertices == 5) {
      std::swap(cell(1), cell(3));
    } else {
      for (int k = 0; k < vertices / 2; ++k) std::swap(cell(k), cell(k + vertices / 2));
    }
    CHECK_THAT(
        message_of<bielle::InputError>([&] {
          check_elements(mesh, {11, 12, 77, 14});
        }),
        StartsWith(fmt::format("1 of {} elements is inverted (negative volume, or folded at a corner); the first "
                               "is element 77 at",
                               mesh.solid_count())));
    CHECK_THAT(message_for(mesh), Contains(fmt::format("first is element {} at", first_number + 2)));
  }
}

TEST_CASE("a hexahedron that is folded at one corner is inverted, and one with a collapsed edge is degenerate") {
  Mesh mesh = mesh_of(CellType::hex8, {1, 1, 1}, {1, 1, 1});
  mesh.points.col(7) = Eigen::Vector3d(0.2, 0.2, 0.2);
  CHECK_THAT(message_for(mesh), Contains("1 of 1 elements is inverted (negative volume, or folded at a corner)"));
  mesh.points.col(7) = mesh.points.col(6);
  CHECK_THAT(message_for(mesh), Contains("1 of 1 elements is degenerate (no volume, or a flat or collapsed corner)"));
}

TEST_CASE("a flat cell of any type, and a mirrored mesh, are refused") {
  for (const CellType type : types) {
    CAPTURE(cell_name(type));
    const Mesh flat =
        mesh_of(type, {1, 1, 1}, {1, 1, 1}, [](const Eigen::Vector3d& x) { return Eigen::Vector3d(x.x(), x.y(), 0); });
    CHECK_THAT(message_of<bielle::InputError>([&] { check_elements(flat, {}); }), Contains("degenerate (no volume"));
    const Mesh mirrored = mesh_of(type, {1, 1, 1}, {2, 1, 1},
                                  [](const Eigen::Vector3d& x) { return Eigen::Vector3d(-x.x(), x.y(), x.z()); });
    CHECK_THAT(message_of<bielle::InputError>([&] { check_elements(mirrored, {}); }),
               StartsWith("every element is inverted (negative volume): the mesh is mirrored"));
  }
}

TEST_CASE("hexahedra with 8 and 20 nodes in one volume are refused") {
  const Mesh one = mesh_of(CellType::hex20, {1, 1, 1}, {1, 1, 1});
  std::string text = as_msh(one);
  const std::string end = "$EndElements";
  text.replace(text.find("$Elements\n7"), 11, "$Elements\n8");
  text.replace(text.find(end), end.size(), "99 5 2 1 1 1 2 4 3 5 6 8 7\n" + end);
  const TemporaryFolder folder;
  CHECK_THAT(import_message(request(folder.file("two.msh", text))),
             Contains("mixes hexahedra with different numbers of nodes in one volume (1 hex20 of 2 cells)"));
}

TEST_CASE("the volume of curved cells is exact under quadratic maps of a box") {
  // The map x -> x + a y^2 e_x has determinant 1; the map x -> (x + a x^2, y, z) moves the end from 1 to 1 + a.
  for (const CellType type : {CellType::hex20, CellType::hex27, CellType::wedge15, CellType::pyramid13}) {
    CAPTURE(cell_name(type));
    const auto shear = [](const Eigen::Vector3d& x) {
      return Eigen::Vector3d(x + Eigen::Vector3d(0.4 * x.y() * x.y(), 0, 0));
    };
    const auto stretch = [](const Eigen::Vector3d& x) {
      return Eigen::Vector3d(x.x() + 0.3 * x.x() * x.x(), x.y(), x.z());
    };
    CHECK(mesh_volume(mesh_of(type, {1, 0.5, 0.25}, {2, 3, 2}, shear)) == Approx(0.125).epsilon(1e-13));
    CHECK(mesh_volume(mesh_of(type, {1, 0.5, 0.25}, {2, 3, 2}, stretch)) == Approx(1.3 * 0.125).epsilon(1e-13));
  }
}

// A quarter of a ring of radii 1 and 2 and height 1.
Eigen::Vector3d ring(const Eigen::Vector3d& x) {
  const double angle = x.y() * std::numbers::pi / 2, radius = 1 + x.x();
  return {radius * std::cos(angle), radius * std::sin(angle), x.z()};
}

TEST_CASE("the volume of a ring converges with order 4 for curved cells, with order 2 for straight ones") {
  const double exact = 0.75 * std::numbers::pi;
  for (const CellType type : types) {
    CAPTURE(cell_name(type));
    const auto error = [&](int n) { return std::abs(mesh_volume(mesh_of(type, {1, 1, 1}, {n, n, 1}, ring)) - exact); };
    const double order = std::log2(error(4) / error(8));
    CHECK(order == Approx(cell_info(type).order == 1 ? 2 : 4).margin(0.1));
  }
}

TEST_CASE("cylinders and planes are found on quadrilaterals of a mesh without names") {
  for (const CellType type : types) {
    CAPTURE(cell_name(type));
    Mesh whole = mesh_of(type, {1, 1, 1}, {3, 8, 2}, ring);
    std::erase_if(whole.groups, [](const auto& group) { return group.second.dimension == 2; });
    const TemporaryFolder folder;
    MeshRequest wish = request(folder.file("ring.msh", as_msh(whole)));
    wish.surfaces = {selection("inner", CylinderSelector{{0, 0, 0}, {0, 0, 1}, 1}),
                     selection("end", PlaneSelector{{0, 0, 0}, {0, 1, 0}})};
    const Mesh mesh = import(wish);
    // Each chord of an arc with the angle pi/16 has the length 2 sin(pi/32).
    CHECK(corner_area(mesh, "inner") == Approx(16 * std::sin(std::numbers::pi / 32)).epsilon(1e-12));
    CHECK((area_vector(mesh, "end") - Eigen::Vector3d(0, -1, 0)).norm() < 1e-12);
    wish.surfaces = {selection("inner", CylinderSelector{{0, 0, 0}, {0, 0, 1}, 0.7})};
    CHECK_THAT(import_message(wish), Contains("the nearest cylinders are: cylinder with radius 1 m about (0, 0, 0.5) m "
                                              "along (0, 0, 1) (a bore)") &&
                                         Contains("cylinder with radius 2 m"));
  }
}

TEST_CASE("straightening repairs an inverted second-order cell and does not change valid ones") {
  for (const CellType type : {CellType::hex20, CellType::hex27, CellType::wedge15, CellType::pyramid13}) {
    CAPTURE(cell_name(type));
    Mesh sound = mesh_of(type, {1, 1, 1}, {2, 2, 1}, ring);
    const Eigen::Matrix3Xd curved = sound.points;
    CHECK(straighten_elements(sound).nodes == 0);
    CHECK(sound.points == curved);

    Mesh mesh = mesh_of(type, {1, 1, 1}, {2, 2, 2});
    const Eigen::Matrix3Xd straight = mesh.points;
    const int node = mesh.blocks.front().nodes(vertex_count(type), 0);
    const Eigen::Vector3d away(0.02, 0.3, 0.4);
    mesh.points.col(node) += away;
    const Eigen::Matrix3Xd x = mesh.points(Eigen::all, mesh.blocks.front().nodes.col(0));
    REQUIRE(checked_determinants(type, x).minCoeff() < 0);
    const Straightening result = straighten_elements(mesh);
    CHECK(result.nodes == 1);
    CHECK(result.farthest == Approx(away.norm()).margin(1e-14));
    CHECK((mesh.points - straight).cwiseAbs().maxCoeff() < 1e-14);
  }
}

TEST_CASE("a distorted cell with nodes in the middle of its edges equals the straight one, as straightening assumes") {
  for (const CellType type : {CellType::hex20, CellType::hex27, CellType::wedge15, CellType::pyramid13}) {
    CAPTURE(cell_name(type));
    // The map is linear on each edge of one brick, but not affine.
    const auto warp = [](const Eigen::Vector3d& x) {
      return Eigen::Vector3d(x.x() + 0.2 * x.y() * x.z(), x.y() - 0.1 * x.x() * x.z(), x.z() + 0.3 * x.x() * x.y());
    };
    Mesh mesh = mesh_of(type, {1, 1, 1}, {1, 1, 1}, warp);
    const CellType straight = straight_type(type);
    for (const auto& cell : mesh.blocks.front().nodes.colwise()) {
      Eigen::Matrix3Xd x = mesh.points(Eigen::all, cell);
      const CellInfo& info = cell_info(type);
      int node = info.vertices;
      for (const auto& [a, b] : info.edges) x.col(node++) = (x.col(a) + x.col(b)) / 2;
      CHECK((checked_determinants(type, x) - checked_determinants(straight, x)).cwiseAbs().maxCoeff() < 1e-13);
      CHECK(cell_volume(type, x) == Approx(cell_volume(straight, x)).epsilon(1e-13));
    }
  }
}

TEST_CASE("the scaled Jacobian of regular cells is 1, and that of others is smaller") {
  const auto quality = [](const Mesh& mesh) { return mesh_quality(mesh).least_scaled_jacobian; };
  CHECK(quality(mesh_of(CellType::hex20, {2, 2, 2}, {2, 2, 2})) == Approx(1).epsilon(1e-14));
  CHECK(quality(mesh_of(CellType::hex8, {5, 1, 1}, {1, 1, 1})) == Approx(1).epsilon(1e-14));
  // A parallelepiped with an angle of 30 degrees.
  CHECK(quality(mesh_of(CellType::hex8, {1, 1, 1}, {1, 1, 1}, [](const Eigen::Vector3d& x) {
          return Eigen::Vector3d(x.x() + std::sqrt(0.75) * x.y(), 0.5 * x.y(), x.z());
        })) == Approx(0.5).epsilon(1e-14));
  // The triangles are right-angled with equal legs, and have sin(45 degrees) at the acute corners.
  CHECK(quality(mesh_of(CellType::wedge6, {1, 1, 1}, {1, 1, 1})) ==
        Approx(2 / std::sqrt(3.0) * std::sqrt(0.5)).epsilon(1e-14));
  Mesh wedge;
  wedge.points.resize(3, 6);
  wedge.points << 0, 1, 0.5, 0, 1, 0.5,              //
      0, 0, std::sqrt(0.75), 0, 0, std::sqrt(0.75),  //
      0, 0, 0, 1, 1, 1;
  wedge.blocks.push_back({CellType::wedge6, Eigen::VectorXi::LinSpaced(6, 0, 5)});
  CHECK(quality(wedge) == Approx(1).epsilon(1e-14));
  Mesh pyramid;
  pyramid.points.resize(3, 5);
  pyramid.points << 0, 1, 1, 0, 0.5,  //
      0, 0, 1, 1, 0.5,                //
      0, 0, 0, 0, std::sqrt(0.5);
  pyramid.blocks.push_back({CellType::pyramid5, Eigen::VectorXi::LinSpaced(5, 0, 4)});
  CHECK(quality(pyramid) == Approx(1).epsilon(1e-14));
  CHECK(mesh_volume(pyramid) == Approx(std::sqrt(0.5) / 3).epsilon(1e-13));
}

TEST_CASE("a box of any type is cut into halves with their faces") {
  for (const CellType type : types) {
    CAPTURE(cell_name(type));
    const Mesh mesh = mesh_of(type, {1, 0.2, 0.2}, {8, 2, 2});
    const CutMesh cut = cut_mesh(mesh, {{"cut_1", {0.5, 0, 0}, {1, 0, 0}, "pieces.cut_1"}}, "x0");
    REQUIRE(cut.pieces.size() == 2);
    REQUIRE(cut.cuts.size() == 1);
    CHECK(cut.cuts[0].distance < 1e-15);
    for (int piece = 0; piece < 2; ++piece) {
      const Mesh& half = cut.pieces[piece].mesh;
      CHECK(mesh_volume(half) == Approx(0.02).epsilon(1e-13));
      CHECK(half.points == mesh.points(Eigen::all, cut.pieces[piece].nodes));
      CHECK(area_vector(half, "pieces.cut_1").x() == Approx(piece == 0 ? 0.04 : -0.04).epsilon(1e-13));
      CHECK(half.groups.contains(piece == 0 ? "x0" : "x1"));
      CHECK_FALSE(half.groups.contains(piece == 0 ? "x1" : "x0"));
      CHECK(area_vector(half, "z1").z() == Approx(0.1).epsilon(1e-13));
    }
  }
}

TEST_CASE("A plate of hexahedra, wedges or pyramids is recognised as one element thick, or as two") {
  for (const CellType type : types) {
    CAPTURE(cell_name(type));
    CHECK(share_one_element_thick(mesh_of(type, {6, 6, 2}, {6, 6, 2})) < 0.02);
    CHECK(share_one_element_thick(mesh_of(type, {1, 1, 1}, {4, 4, 4})) == 0);
    // A brick of six pyramids has two of them across its thickness.
    if (vertex_count(type) != 5) CHECK(share_one_element_thick(mesh_of(type, {6, 6, 1}, {6, 6, 1})) > 0.5);
  }
}

}  // namespace test_cell_meshes
