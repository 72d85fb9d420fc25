// Tests of the internal modes of cells of order 1, and of the mean strain of all types of cells except simplices.
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "reduce/fe/mean_strain.hpp"
#include "reduce/fe/stress.hpp"
#include "reduce/mesh/shape_functions.hpp"
#include "tests/support/cell_box.hpp"
#include "tests/support/solid_model.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace {

const Eigen::Vector3d cell_sides(1.2, 0.9, 0.7);
const Material soft_steel = Material::isotropic(2e5, 0.3, 4);

/// Stiffness of a single cell times unit displacements of its nodes.
Eigen::MatrixXd stiffness_of_cell(CellType type, const Eigen::Matrix3Xd& points, const Eigen::VectorXi& nodes) {
  Mesh mesh;
  mesh.points = points;
  mesh.blocks.push_back({type, nodes});
  const test::SolidModel model(mesh, soft_steel);
  return model.stiffness.multiply(RowMatrix::Identity(points.size(), points.size()), 1);
}

}  // namespace

TEST_CASE("The stiffness of a cell does not depend on its first node") {
  struct Numbering {
    CellType type;
    std::vector<int> nodes;  ///< the same cell with another first node, or with other edges as its axes
  };
  for (const Numbering& numbering :
       {Numbering{CellType::hex8, {1, 2, 3, 0, 5, 6, 7, 4}}, Numbering{CellType::hex8, {0, 3, 7, 4, 1, 2, 6, 5}},
        Numbering{CellType::wedge6, {1, 2, 0, 4, 5, 3}}, Numbering{CellType::wedge6, {3, 5, 4, 0, 2, 1}}}) {
    CAPTURE(cell_name(numbering.type), numbering.nodes);
    // The Jacobian varies and its determinant does not: the integrands are polynomials, which are integrated exactly.
    Eigen::Matrix3Xd x = local_nodes(numbering.type);
    x.row(0) += 0.2 * x.row(1).cwiseProduct(x.row(2)) + 0.3 * x.row(1);
    const Eigen::VectorXi nodes = Eigen::Map<const Eigen::VectorXi>(numbering.nodes.data(), x.cols());
    const Eigen::MatrixXd K =
        stiffness_of_cell(numbering.type, x, Eigen::VectorXi::LinSpaced(x.cols(), 0, static_cast<int>(x.cols()) - 1));
    CHECK((stiffness_of_cell(numbering.type, x, nodes) - K).norm() < 1e-12 * K.norm());
  }
}

TEST_CASE("Rectangular hexahedra of order 1 have the stress of pure bending exactly") {
  // u is the displacement of a beam with curvature k in the plane of x and y and with lateral contraction: the only
  // stress is E k y along x.
  const double k = 0.01, poisson = 0.3;
  const Mesh mesh = test::cell_box(CellType::hex8, cell_sides, {2, 3, 2});
  const test::SolidModel model(mesh, soft_steel);
  RowMatrix u(3 * mesh.point_count(), 1);
  std::vector<int> nodes;
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a) {
    const Eigen::Vector3d x = mesh.points.col(a);
    u.middleRows<3>(3 * a) << k * x.x() * x.y(), -k / 2 * (x.x() * x.x() + poisson * (x.y() * x.y() - x.z() * x.z())),
        -poisson * k * x.y() * x.z();
    nodes.push_back(static_cast<int>(a));
  }
  const RowMatrix stress = nodal_stress(model.solid, u, nodes);
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a) {
    Eigen::Matrix<double, 6, 1> expected = Eigen::Matrix<double, 6, 1>::Zero();
    expected(0) = 2e5 * k * mesh.points(1, a);
    CHECK((stress.middleRows<6>(6 * a) - expected).norm() < 1e-9 * 2e5 * k);
  }
}

TEST_CASE("A displacement that is zero on the surface has no mean strain") {
  // The mean gradient is the integral of u n^T over the surface, divided by the volume.
  const CellType type = GENERATE(CellType::hex8, CellType::wedge6, CellType::hex20, CellType::wedge15);
  CAPTURE(cell_name(type));
  const Mesh mesh = test::cell_box(type, cell_sides, {3, 3, 3}, [](const Eigen::Vector3d& x) {
    const double inside = (4 * x.array() * (cell_sides - x).array() / cell_sides.array().square()).prod();
    return Eigen::Vector3d(x + 0.1 * inside * Eigen::Vector3d(std::sin(9 * x.y()), std::cos(7 * x.z()), x.x()));
  });
  const test::SolidModel model(mesh, soft_steel);
  RowMatrix u = RowMatrix::Zero(3 * mesh.point_count(), 1);
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a) {
    const Eigen::Array3d x = mesh.points.col(a).array();
    if ((x > 1e-9).all() && (x < cell_sides.array() - 1e-9).all())
      u.middleRows<3>(3 * a) << 1, std::cos(static_cast<double>(a)), std::sin(static_cast<double>(a));
  }
  REQUIRE(u.norm() > 1);
  CHECK(mean_strain(model.solid, u).norm() < 1e-13 * u.norm());
}
