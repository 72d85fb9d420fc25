// Tests of meshes with several types of solid cells, and of meshes whose cells do not fit together.
#include "import_support.hpp"
#include <catch2/catch.hpp>

#include "reduce/mesh/checks.hpp"
#include "reduce/mesh/conforming.hpp"
#include "reduce/mesh/cut_mesh.hpp"
#include "reduce/mesh/measures.hpp"
#include "reduce/mesh/straighten.hpp"
#include "reduce/mesh/wall_thickness.hpp"
#include "tests/support/cell_box.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::reduce;
using namespace bielle::test;
using Catch::Contains;

namespace test_mixed_meshes {

std::string refusal(const Mesh& mesh) {
  const TemporaryFolder folder;
  return import_message(request(folder.file("body.msh", as_msh(mesh))));
}

// Adds the cells of another mesh as a separate volume, and merges coincident nodes.
Mesh joined(Mesh mesh, const Mesh& other) {
  std::vector<int> number;
  std::vector<Eigen::Vector3d> points;
  for (const auto& x : mesh.points.colwise()) points.emplace_back(x);
  for (const auto& x : other.points.colwise()) {
    const auto same = std::find_if(points.begin(), points.end(),
                                   [&](const Eigen::Vector3d& point) { return (point - x).norm() < 1e-9; });
    number.push_back(static_cast<int>(same - points.begin()));
    if (same == points.end()) points.emplace_back(x);
  }
  mesh.points.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) mesh.points.col(static_cast<Eigen::Index>(k)) = points[k];
  std::erase_if(mesh.groups, [](const auto& group) { return group.second.dimension == 2; });
  Group more{3, {}, {}};
  for (const CellBlock& block : other.blocks) {
    if (dimension(block.type) != 3) continue;
    Eigen::MatrixXi nodes = block.nodes;
    for (int& node : nodes.reshaped()) node = number[static_cast<std::size_t>(node)];
    Eigen::Index before = 0;
    if (const CellBlock* same = mesh.block(block.type)) {
      before = same->nodes.cols();
      Eigen::MatrixXi both(nodes.rows(), before + nodes.cols());
      both << same->nodes, nodes;
      std::find_if(mesh.blocks.begin(), mesh.blocks.end(), [&](const CellBlock& of) {
        return of.type == block.type;
      })->nodes = both;
    } else {
      mesh.blocks.push_back({block.type, nodes});
    }
    std::vector<int> cells;
    for (int e = 0; e < nodes.cols(); ++e) cells.push_back(static_cast<int>(before) + e);
    more.parts.push_back({block.type, cells});
  }
  mesh.groups["more"] = more;
  return mesh;
}

Mesh moved(Mesh mesh, const Eigen::Vector3d& way) {
  mesh.points.colwise() += way;
  return mesh;
}

TEST_CASE("a box of several types of cells has its volume, and faces that point outward") {
  for (const int order : {1, 2}) {
    CAPTURE(order);
    const Mesh mesh = mixed_box(order, {0.3, 0.2, 0.1}, {3, 2, 2});
    CHECK(mesh_volume(mesh) == Approx(0.006).epsilon(1e-13));
    CHECK_NOTHROW(check_elements(mesh, {}));
    CHECK_NOTHROW(check_connected(mesh));
    const FaceTable faces(mesh);
    CHECK_NOTHROW(check_conforming(mesh, faces));
    CHECK(loose_joints(mesh, faces).empty());
    CHECK(coincident_nodes(mesh, faces).pairs == 0);
    double divergence = 0, area = 0;  // by Gauss' theorem 3 V is the sum of x . n dA over plane faces
    for (const int face : faces.boundary()) {
      const Eigen::Vector3d normal = bielle::reduce::area_vector(mesh.points, faces.corners(face));
      divergence += mesh.points.col(faces.corners(face)[0]).dot(normal);
      area += normal.norm();
      CHECK(faces.nodes(face).size() == node_count(faces.type(face)));
      CHECK(faces.find(faces.corners(face)) == face);
    }
    CHECK(divergence / 3 == Approx(0.006).epsilon(1e-13));
    CHECK(area == Approx(2 * (0.06 + 0.03 + 0.02)).epsilon(1e-13));
    // There are six columns of two bricks; (i + j) mod 3 is 0 for hexahedra, 1 for wedges, 2 for pyramids.
    for (const auto* part : {"4 hex", "8 wedge", "20 pyramid", "8 tet"}) CHECK_THAT(summary(mesh), Contains(part));
    CHECK(share_one_element_thick(mixed_box(order, {3, 3, 3}, {3, 3, 3})) == 0);
  }
}

TEST_CASE("a mixed mesh is imported with its groups, numbers and materials of cells") {
  const TemporaryFolder folder;
  for (const int order : {1, 2}) {
    CAPTURE(order);
    const Mesh whole = mixed_box(order, {0.3, 0.2, 0.1}, {3, 2, 2});
    const Mesh mesh = import(request(folder.file("body.msh", as_msh(whole))));
    CHECK(mesh.point_count() == whole.point_count());
    CHECK(mesh_volume(mesh) == Approx(0.006).epsilon(1e-13));
    REQUIRE(mesh.solid_count() == 40);
    for (const auto& [name, group] : whole.groups) {
      CAPTURE(name);
      CHECK(mesh.groups.at(name).nodes.size() == group.nodes.size());
      CHECK(mesh.groups.at(name).parts.size() == group.parts.size());
    }
    CHECK(area_vector(mesh, "z1").z() == Approx(0.06).epsilon(1e-13));
    const SolidCells cells(mesh);
    CHECK(cells.members(mesh.groups.at("solid")).size() == 40);
    CHECK(mesh.groups.at("solid").nodes.size() == static_cast<std::size_t>(mesh.point_count()));
  }
}

TEST_CASE("an inverted cell of a mixed mesh is named by its number in the file") {
  Mesh mesh = mixed_box(1, {0.3, 0.2, 0.1}, {3, 2, 2});
  int first = 1;  // the group of solid cells is the first one in the file
  for (const CellBlock& block : mesh.blocks) {
    if (block.type == CellType::wedge6) break;
    first += static_cast<int>(block.nodes.cols());
  }
  auto wedge = const_cast<CellBlock*>(mesh.block(CellType::wedge6))->nodes.col(3);
  for (int k = 0; k < 3; ++k) std::swap(wedge(k), wedge(k + 3));
  CHECK_THAT(refusal(mesh), Contains(fmt::format("1 of 40 elements is inverted (negative volume, or folded at a "
                                                 "corner); the first is element {} at",
                                                 first + 3)));
}

TEST_CASE("a mixed mesh is cut into halves with their groups") {
  for (const int order : {1, 2}) {
    CAPTURE(order);
    const Mesh mesh = mixed_box(order, {1, 0.2, 0.2}, {8, 2, 2});
    const CutMesh cut = cut_mesh(mesh, {{"cut_1", {0.5, 0, 0}, {1, 0, 0}, "pieces.cut_1"}}, "x0");
    REQUIRE(cut.pieces.size() == 2);
    for (int piece = 0; piece < 2; ++piece) {
      const Mesh& half = cut.pieces[piece].mesh;
      CHECK(mesh_volume(half) == Approx(0.02).epsilon(1e-13));
      CHECK(half.points == mesh.points(Eigen::all, cut.pieces[piece].nodes));
      CHECK(half.groups.contains(piece == 0 ? "x0" : "x1"));
      CHECK_FALSE(half.groups.contains(piece == 0 ? "x1" : "x0"));
      CHECK(static_cast<Eigen::Index>(SolidCells(half).members(half.groups.at("solid")).size()) == half.solid_count());
    }
  }
}

TEST_CASE("straightening repairs the cells of order 2 of every type in a mixed mesh") {
  Mesh mesh = mixed_box(2, {1, 1, 1}, {3, 1, 2});
  const Eigen::Matrix3Xd straight = mesh.points;
  for (const CellType type : {CellType::hex20, CellType::wedge15, CellType::pyramid13}) {
    const int node = mesh.block(type)->nodes(vertex_count(type), 0);
    mesh.points.col(node) += Eigen::Vector3d(0.02, 0.5, 0.6);
  }
  CHECK(straighten_elements(mesh).nodes >= 2);  // cells may share edges
  CHECK((mesh.points - straight).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("cells of order 1 and of order 2 in one mesh are refused") {
  const Mesh linear = cell_box(CellType::hex8, {1, 1, 1}, {1, 2, 2});
  CHECK_THAT(
      refusal(joined(linear, moved(cell_box(CellType::hex20, {1, 1, 1}, {1, 2, 2}), {1, 0, 0}))),
      Contains("4 faces between cells do not have the same nodes on both sides (hex20, hex8), the first at (1, "));
  CHECK_THAT(
      refusal(joined(cell_box(CellType::hex20, {1, 1, 1}, {1, 1, 1}),
                     moved(cell_box(CellType::hex27, {1, 1, 1}, {1, 1, 1}), {1, 0, 0}))),
      Contains("1 face between cells does not have the same nodes on both sides (hex20, hex27), the first at (1, 0.5, "
               "0.5) m: the body would be torn open between the corners; use cells with the same number of "
               "nodes on an edge and on a face"));
  // Wedges meet hexahedra.
  const TemporaryFolder folder;
  const Mesh fits = joined(linear, moved(cell_box(CellType::wedge6, {1, 1, 1}, {1, 2, 2}), {1, 0, 0}));
  CHECK(import(request(folder.file("body.msh", as_msh(fits)))).solid_count() == 12);
}

TEST_CASE("a quadrilateral on two triangles is refused, along either diagonal") {
  const Mesh box = cell_box(CellType::hex8, {1, 1, 1}, {1, 1, 1});
  const std::string message =
      "1 quadrilateral face of solid cells stands against two triangles, the first at (1, 0.5, 0.5) m: the "
      "displacements of both sides would part there; pyramids join hexahedra and tetrahedra";
  CHECK_THAT(refusal(joined(box, moved(cell_box(CellType::tet4, {1, 1, 1}, {1, 1, 1}), {1, 0, 0}))), Contains(message));
  const PointMap turned = [](const Eigen::Vector3d& x) { return Eigen::Vector3d(x.x(), 1 - x.z(), x.y()); };
  CHECK_THAT(refusal(joined(box, moved(cell_box(CellType::tet4, {1, 1, 1}, {1, 1, 1}, turned), {1, 0, 0}))),
             Contains(message));
}

TEST_CASE("hanging nodes are refused: two hexahedra on one") {
  const Mesh below = cell_box(CellType::hex8, {2, 1, 1}, {1, 1, 1});
  const Mesh above = moved(cell_box(CellType::hex8, {2, 1, 1}, {2, 1, 1}), {0, 0, 1});
  CHECK_THAT(refusal(joined(below, above)),
             Contains("2 edges of solid cells have a corner of another cell in their middle, the first at (1, 0, 1) m: "
                      "hanging nodes join nothing; divide the larger cells there too"));
  const Mesh below_2 = cell_box(CellType::hex20, {2, 1, 1}, {1, 1, 1});
  const Mesh above_2 = moved(cell_box(CellType::hex20, {2, 1, 1}, {2, 1, 1}), {0, 0, 1});
  CHECK_THAT(refusal(joined(below_2, above_2)), Contains("2 edges of solid cells have a corner of another cell"));
}

}  // namespace test_mixed_meshes
