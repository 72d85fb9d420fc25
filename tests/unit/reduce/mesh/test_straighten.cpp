// Tests of the repair of inverted curved elements.
#include "import_support.hpp"
#include <catch2/catch.hpp>

#include "reduce/mesh/jacobian.hpp"
#include "reduce/mesh/measures.hpp"
#include "reduce/mesh/straighten.hpp"
#include "tests/support/box_mesh.hpp"

using namespace bielle::reduce;
using namespace bielle::test;

namespace {

double least_ratio(const Mesh& mesh) {
  double least = 1;
  const CellBlock& solids = mesh.blocks.front();
  for (Eigen::Index e = 0; e < solids.nodes.cols(); ++e) {
    const Eigen::Matrix3Xd x = mesh.points(Eigen::all, solids.nodes.col(e));
    least = std::min(least, determinant_coefficients(x).minCoeff() / straight_determinant(x));
  }
  return least;
}

}  // namespace

TEST_CASE("valid curved elements are not changed") {
  Mesh mesh = box_mesh({{1, 1, 1}, {3, 3, 3}, true}, [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x + Eigen::Vector3d(0.2 * x.y() * x.y(), 0, 0));
  });
  const Eigen::Matrix3Xd before = mesh.points;
  const Straightening result = straighten_elements(mesh);
  CHECK(result.elements == 0);
  CHECK(result.nodes == 0);
  CHECK(mesh.points == before);
}

TEST_CASE("only the mid-side node that inverts elements is moved to the middle of its edge") {
  Mesh mesh = box_mesh({{1, 1, 1}, {2, 2, 2}, true});
  const Eigen::Matrix3Xd straight = mesh.points;
  const int node = mesh.blocks.front().nodes(4, 0);
  const Eigen::Vector3d away(0.01, 0.3, 0.2);
  mesh.points.col(node) += away;
  REQUIRE(least_ratio(mesh) < 0);
  const double volume = mesh_volume(mesh);
  const Straightening result = straighten_elements(mesh);
  CHECK(result.nodes == 1);
  CHECK(result.elements >= 1);
  CHECK(result.farthest == Approx(away.norm()).margin(1e-14));
  CHECK(result.volume_change == Approx(1 / volume - 1).margin(1e-12));
  CHECK((result.place - straight.col(node)).norm() < 1e-14);
  CHECK((mesh.points - straight).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("the mesh of the coarse connecting rod has inverted elements at fillets, which the import repairs") {
  MeshRequest wish = request(std::string(BIELLE_SOURCE_DIR) + "/meshes/conrod.geo");
  wish.length_unit = "mm";
  wish.size = 6e-3;
  CHECK(least_ratio(import(wish)) > 0);
  // gmsh's mesh without the repair shows that the repair is needed.
  const std::string raw = std::string(BIELLE_BINARY_DIR) + "/conrod_raw.msh";
  gmsh_convert(wish.path, raw, 6, 2);
  MeshRequest again = request(raw);
  again.length_unit = "mm";
  Mesh mesh = import(again);
  CHECK(least_ratio(mesh) > 0);
  CHECK(straighten_elements(mesh).nodes == 0);
}
