// Tests of the import of geometries and meshes of gmsh's formats: meshes in metres with named groups.
#include <cmath>
#include <numbers>
#include <set>

#include "import_support.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "reduce/mesh/gmsh/volumes.hpp"
#include "reduce/mesh/measures.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace bielle::reduce;
using namespace bielle::test;
using Catch::Matchers::WithinRel;

namespace {

// Returns a box of 0.3 x 0.2 x 0.1 units times `scale`, with or without names.
std::string box_geo(double scale, bool named = true) {
  return fmt::format(
      "SetFactory(\"OpenCASCADE\"); s = {0};\n"
      "Box(1) = {{0, 0, 0, 0.3*s, 0.2*s, 0.1*s}};\n{1}",
      scale,
      named ? "Physical Volume(\"solid\") = {1};\n"
              "Physical Surface(\"left\") = Surface In BoundingBox {-.01*s, -s, -s, .01*s, s, s};\n"
              "Physical Surface(\"right\") = Surface In BoundingBox {.29*s, -s, -s, .31*s, s, s};\n"
            : "");
}

MeshRequest box_request(const std::string& path, int order) {
  MeshRequest result = request(path);
  result.size = 0.06;
  result.order = order;
  return result;
}

// Returns the slope of log(error) over log(h) by least squares.
double slope(const std::vector<double>& h, const std::vector<double>& error) {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < h.size(); ++i) {
    x += std::log(h[i]), y += std::log(error[i]);
    xx += std::log(h[i]) * std::log(h[i]), xy += std::log(h[i]) * std::log(error[i]);
  }
  const double n = static_cast<double>(h.size());
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace

TEST_CASE("a box with named groups has its volume, and faces that point outward") {
  const TemporaryFolder folder;
  const std::string path = folder.file("box.geo", box_geo(1));
  for (int order : {1, 2}) {
    const Mesh mesh = import(box_request(path, order));
    const CellType solid = order == 1 ? CellType::tet4 : CellType::tet10;
    REQUIRE(mesh.block(solid) != nullptr);
    CHECK(mesh.solid_count() == mesh.block(solid)->nodes.cols());
    // Straight elements fill a box exactly, up to the rounding of a few thousand additions.
    CHECK_THAT(mesh_volume(mesh), WithinRel(0.006, 1e-12));
    CHECK((area_vector(mesh, "left") - Eigen::Vector3d(-0.02, 0, 0)).norm() < 1e-14);
    CHECK((area_vector(mesh, "right") - Eigen::Vector3d(0.02, 0, 0)).norm() < 1e-14);
    CHECK(mesh.groups.at("left").dimension == 2);
    CHECK(mesh.groups.at("solid").dimension == 3);
    CHECK(static_cast<Eigen::Index>(mesh.groups.at("solid").nodes.size()) == mesh.point_count());
    CHECK_FALSE(mesh.groups.contains("all"));
    for (int node : mesh.groups.at("left").nodes) CHECK(std::abs(mesh.points(0, node)) < 1e-14);
  }
}

TEST_CASE("every node of a second-order box lies in the middle of its edge, in gmsh's order") {
  const TemporaryFolder folder;
  const Mesh mesh = import(box_request(folder.file("box.geo", box_geo(1)), 2));
  constexpr int ends[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}};
  const CellBlock& solids = mesh.blocks.front();
  double worst = 0;
  for (Eigen::Index e = 0; e < solids.nodes.cols(); ++e)
    for (int k = 0; k < 6; ++k) {
      const Eigen::Vector3d middle =
          (mesh.points.col(solids.nodes(ends[k][0], e)) + mesh.points.col(solids.nodes(ends[k][1], e))) / 2;
      worst = std::max(worst, (mesh.points.col(solids.nodes(4 + k, e)) - middle).norm());
    }
  CHECK(worst < 1e-14);
  const CellBlock& surface = *mesh.block(CellType::tri6);
  for (Eigen::Index e = 0; e < surface.nodes.cols(); ++e)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d middle =
          (mesh.points.col(surface.nodes(k, e)) + mesh.points.col(surface.nodes((k + 1) % 3, e))) / 2;
      CHECK((mesh.points.col(surface.nodes(3 + k, e)) - middle).norm() < 1e-14);
    }
}

TEST_CASE("a body without physical volumes is the region 'all'") {
  const TemporaryFolder folder;
  const Mesh mesh = import(box_request(folder.file("box.geo", box_geo(1, false)), 1));
  CHECK(mesh.groups.size() == 1);
  CHECK(static_cast<Eigen::Index>(mesh.groups.at("all").parts.front().cells.size()) == mesh.solid_count());
  CHECK(mesh.block(CellType::tri3) == nullptr);
}

TEST_CASE("lengths are metres for any unit of the file") {
  const TemporaryFolder folder;
  const std::string geo = folder.file("box.geo", box_geo(1000));
  gmsh_convert(geo, folder / "box.msh", 60, 2);
  gmsh_convert(geo, folder / "box.step", 60, 2);
  gmsh_convert(geo, folder / "box.brep", 60, 2);
  gmsh_convert(geo, folder / "box.unv", 60, 2);
  for (const std::string name : {"box.geo", "box.msh", "box.step", "box.brep", "box.unv"}) {
    CAPTURE(name);
    MeshRequest wish = request(folder / name);
    if (name != "box.step") wish.length_unit = "mm";  // gmsh writes STEP files in mm and declares this unit
    if (!name.ends_with(".msh") && !name.ends_with(".unv")) wish.size = 0.06;
    const Mesh mesh = import(wish);
    CHECK(mesh.block(CellType::tet10) != nullptr);
    // UNV files have 17 digits and STEP files 15, far more than this tolerance.
    CHECK_THAT(mesh_volume(mesh), WithinRel(0.006, 1e-10));
    CHECK((mesh.points.rowwise().maxCoeff() - Eigen::Vector3d(0.3, 0.2, 0.1)).norm() < 1e-10);
    if (!wish.size || name == "box.geo") {
      CHECK((area_vector(mesh, "left") - Eigen::Vector3d(-0.02, 0, 0)).norm() < 1e-12);
      CHECK(mesh.groups.at("solid").dimension == 3);
    }
  }
}

TEST_CASE("the volume of a meshed cylinder converges to pi r^2 h, with order 2 for straight and 4 for curved elements",
          "[long]") {
  const TemporaryFolder folder;
  const std::string path =
      folder.file("cylinder.geo", "SetFactory(\"OpenCASCADE\"); Cylinder(1) = {0,0,0, 0,0,0.2, 1};");
  const double exact = std::numbers::pi * 0.2;
  CHECK_THAT(geometry_volume(path), WithinRel(exact, 1e-12));
  for (int order : {1, 2}) {
    std::vector<double> sizes, errors;
    for (double size : {0.25, 0.17, 0.12, 0.08, 0.055}) {
      MeshRequest wish = request(path);
      wish.size = size;
      wish.order = order;
      const Mesh mesh = import(wish);
      sizes.push_back(std::cbrt(exact / static_cast<double>(mesh.solid_count())));
      errors.push_back(std::abs(mesh_volume(mesh) / exact - 1));
    }
    CAPTURE(order, sizes, errors);
    // The meshes are not similar, which changes the order by up to a tenth.
    CHECK_THAT(slope(sizes, errors), WithinRel(order == 1 ? 2.0 : 4.0, 0.1));
  }
}

TEST_CASE("the connecting rod has OpenCASCADE's volume, as .geo and as .step", "[long]") {
  const std::string folder = std::string(BIELLE_SOURCE_DIR) + "/meshes/";
  const double volume = geometry_volume(folder + "conrod.geo", "mm");
  // OpenCASCADE integrates over trimmed surfaces numerically: both volumes differ from the limit of fine meshes by
  // about 1e-5.
  CHECK_THAT(geometry_volume(folder + "conrod.step"), WithinRel(volume, 1e-4));
  for (const std::string name : {"conrod.geo", "conrod.step"}) {
    MeshRequest wish = request(folder + name);
    if (name == "conrod.geo") wish.length_unit = "mm";
    wish.size = 4.6e-3;
    CHECK_THAT(mesh_volume(import(wish)), WithinRel(volume, 1e-3));  // mesh error of straightened elements at fillets
  }
}

TEST_CASE("the same request gives the same mesh") {
  MeshRequest wish = request(std::string(BIELLE_SOURCE_DIR) + "/meshes/conrod.geo");
  wish.length_unit = "mm";
  wish.size = 6e-3;
  const Mesh one = import(wish), other = import(wish);
  CHECK(one.points == other.points);
  CHECK(one.blocks.front().nodes == other.blocks.front().nodes);
}

TEST_CASE("mesh.sizes refines a physical group, a volume, and a surface that is selected by shape") {
  const TemporaryFolder folder;
  const std::string path = folder.file("box.geo", box_geo(1));
  const auto smallest_edge_on = [](const Mesh& mesh, double x) {
    double sum = 0;
    int count = 0;
    constexpr int ends[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}};
    for (Eigen::Index e = 0; e < mesh.blocks.front().nodes.cols(); ++e)
      for (const auto& edge : ends) {
        const Eigen::Vector3d a = mesh.points.col(mesh.blocks.front().nodes(edge[0], e)),
                              b = mesh.points.col(mesh.blocks.front().nodes(edge[1], e));
        if (std::abs(a.x() - x) > 1e-9 || std::abs(b.x() - x) > 1e-9) continue;
        sum += (a - b).norm();
        ++count;
      }
    return sum / count;
  };
  MeshRequest wish = box_request(path, 1);
  const Mesh coarse = import(wish);
  wish.sizes["left"] = {0.02, ""};
  const Mesh left = import(wish);
  CHECK_THAT(smallest_edge_on(left, 0), WithinRel(0.02, 0.2));  // gmsh makes edges whose mean length is the size
  CHECK_THAT(smallest_edge_on(left, 0.3), WithinRel(smallest_edge_on(coarse, 0.3), 0.2));
  wish.sizes = {{"interfaces.end", {0.02, ""}}};
  wish.surfaces = {selection("interfaces.end", PlaneSelector{{0.3, 0, 0}, {1, 0, 0}})};
  const Mesh right = import(wish);
  CHECK_THAT(smallest_edge_on(right, 0.3), WithinRel(0.02, 0.2));
  CHECK(right.groups.at("interfaces.end").nodes == right.groups.at("right").nodes);
  wish.sizes = {{"solid", {0.03, ""}}};
  CHECK_THAT(smallest_edge_on(import(wish), 0), WithinRel(0.03, 0.2));
  wish.sizes = {{"rihgt", {0.03, "mesh.sizes.rihgt"}}};
  CHECK_THAT(import_message(wish), Catch::Matchers::StartsWith("mesh.sizes.rihgt: 'rihgt' is no physical group") &&
                                       Catch::Matchers::Contains("did you mean 'right'?"));
}

TEST_CASE("a refined mesh has no influence on the next one") {
  const TemporaryFolder folder;
  const MeshRequest plain = box_request(folder.file("box.geo", box_geo(1)), 1);
  const Mesh before = import(plain);
  MeshRequest refined = plain;
  refined.sizes["left"] = {0.02, ""};
  CHECK(import(refined).point_count() > before.point_count());
  CHECK(import(plain).points == before.points);
}

TEST_CASE("two regions share the nodes of their common face, and a group may lie inside the body") {
  const TemporaryFolder folder;
  const std::string path =
      folder.file("two.geo",
                  "SetFactory(\"OpenCASCADE\"); Box(1) = {0,0,0, 1,1,1}; Box(2) = {1,0,0, 1,1,1};\n"
                  "BooleanFragments{ Volume{1,2}; Delete; }{}\n"
                  "Physical Volume(\"a\") = {1}; Physical Volume(\"b\") = {2};\n"
                  "Physical Surface(\"between\") = Surface In BoundingBox {.9,-1,-1, 1.1,2,2};\n");
  MeshRequest wish = request(path);
  wish.size = 0.5;
  const Mesh mesh = import(wish);
  CHECK_THAT(mesh_volume(mesh), WithinRel(2.0, 1e-12));
  std::vector<int> common;
  std::set_intersection(mesh.groups.at("a").nodes.begin(), mesh.groups.at("a").nodes.end(),
                        mesh.groups.at("b").nodes.begin(), mesh.groups.at("b").nodes.end(), std::back_inserter(common));
  CHECK(common == mesh.groups.at("between").nodes);
  CHECK_THAT(corner_area(mesh, "between"), WithinRel(1.0, 1e-12));
}

TEST_CASE("groups without names are named by their number; sparse node numbers and unused nodes are allowed") {
  const TemporaryFolder folder;
  std::string text = msh({"0 0 0", "1 0 0", "0 1 0", "0 0 1", "5 5 5"}, {"4 2 7 1 1 2 3 4", "2 2 9 1 1 3 2"});
  // Node 4 is renumbered to 4000000.
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"4 0 0 1\n", "4000000 0 0 1\n"}, {"1 2 3 4\n", "1 2 3 4000000\n"}})
    text.replace(text.find(from), from.size(), to);
  const Mesh mesh = import(request(folder.file("one.msh", text)));
  CHECK(mesh.point_count() == 4);
  CHECK_THAT(mesh_volume(mesh), WithinRel(1.0 / 6, 1e-14));
  CHECK(mesh.groups.at("volume_7").nodes == std::vector<int>{0, 1, 2, 3});
  CHECK((area_vector(mesh, "surface_9") - Eigen::Vector3d(0, 0, -0.5)).norm() < 1e-15);
}
