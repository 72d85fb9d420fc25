// Single cells against the matrices that CalculiX makes of them (tests/references/calculix_cells.py).
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "reduce/fe/assembly.hpp"
#include "reduce/mesh/quadrature.hpp"
#include "reduce/mesh/shape_functions.hpp"
#include "tests/support/reference_table.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace test_calculix_cells {

/// Returns the cells of the script: images of the reference cell under a linear map, or distorted with straight edges.
Mesh single_cell(CellType type, bool distorted) {
  Eigen::Matrix3d A;
  A << 1.1, 0.2, -0.1, 0.1, 0.9, 0.3, 0.05, -0.2, 1.2;
  const Eigen::Matrix3Xd local = local_nodes(type);
  Mesh mesh;
  mesh.points = A * local;
  for (Eigen::Index a = 0; distorted && a < local.cols(); ++a) {
    const double r = local(0, a), s = local(1, a), t = local(2, a);
    mesh.points.col(a) += 0.1 * Eigen::Vector3d(r * t, 0.5 * s * t, -r * t);
  }
  mesh.blocks.push_back({type, Eigen::VectorXi::LinSpaced(node_count(type), 0, node_count(type) - 1)});
  return mesh;
}

/// Returns four displacement fields, (3 nodes, 4).
RowMatrix fields(const Mesh& mesh) {
  RowMatrix u(3 * mesh.point_count(), 4);
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a)
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 4; ++k)
        u(3 * a + i, k) = std::sin(1 + k + 2 * i + (1 + 0.3 * k) * mesh.points(0, a) +
                                   (0.5 + 0.1 * k) * mesh.points(1, a) - 0.7 * mesh.points(2, a));
  return u;
}

/// Returns the largest difference of the forms u^T A v to those of the table, by the largest of them.
double difference(const Eigen::MatrixXd& forms, const std::string& name) {
  static const test::ReferenceTable calculix("calculix_cells");
  double worst = 0, largest = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j <= i; ++j) {
      const double value = calculix(name + "." + std::to_string(i) + std::to_string(j));
      worst = std::max(worst, std::abs(forms(i, j) - value));
      largest = std::max(largest, std::abs(value));
    }
  return worst / largest;
}

/// Returns the points of `low` in the triangle times Gauss' points along the height.
Quadrature wedge_rule(const Quadrature& triangle, int height) {
  const Quadrature line = cell_quadrature(CellType::hex8, height);  // its first points differ in one coordinate alone
  std::map<double, double> along;
  for (Eigen::Index p = 0; p < line.weights.size(); ++p) along[line.points(2, p)] += line.weights(p) / 4;
  const auto count = static_cast<Eigen::Index>(along.size()) * triangle.weights.size();
  Quadrature rule{Eigen::MatrixXd(3, count), Eigen::VectorXd(count)};
  Eigen::Index k = 0;
  for (const auto& [z, weight] : along)
    for (Eigen::Index p = 0; p < triangle.weights.size(); ++p, ++k) {
      rule.points.col(k) << triangle.points.col(p), z;
      rule.weights(k) = weight * triangle.weights(p);
    }
  return rule;
}

/// K and M of one cell by the points of a rule, without internal modes: (3 nodes, 3 nodes).
struct Matrices {
  Eigen::MatrixXd K, M;
};
Matrices by_points(CellType type, const Eigen::Matrix3Xd& x, const Material& material, const Quadrature& rule) {
  const Eigen::Index n = x.cols();
  Matrices result{Eigen::MatrixXd::Zero(3 * n, 3 * n), Eigen::MatrixXd::Zero(3 * n, 3 * n)};
  for (Eigen::Index p = 0; p < rule.weights.size(); ++p) {
    const Eigen::Matrix3d jacobian = x * shape_gradients(type, rule.points.col(p));
    const Eigen::MatrixXd gradients = shape_gradients(type, rule.points.col(p)) * jacobian.inverse();
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(6, 3 * n);  // xx yy zz yz xz xy
    for (Eigen::Index a = 0; a < n; ++a) {
      const double gx = gradients(a, 0), gy = gradients(a, 1), gz = gradients(a, 2);
      B.middleCols<3>(3 * a) << gx, 0, 0, 0, gy, 0, 0, 0, gz, 0, gz, gy, gz, 0, gx, gy, gx, 0;
    }
    const double volume = rule.weights(p) * jacobian.determinant();
    result.K += volume * B.transpose() * material.elasticity * B;
    const Eigen::VectorXd N = shape_values(type, rule.points.col(p));
    for (int i = 0; i < 3; ++i)
      result.M(Eigen::seqN(i, n, 3), Eigen::seqN(i, n, 3)) += material.density * volume * N * N.transpose();
  }
  return result;
}

TEST_CASE("Stiffness and mass of single cells are those of CalculiX, by its points of integration") {
  // CalculiX takes one point in the triangle of C3D6 and three in that of C3D15, and for the mass the points of the
  // stiffness, while Bielle integrates affine cells exactly. Both are compared with sums over the same points.
  const Quadrature one_in_triangle = simplex_quadrature(2, 1);
  Quadrature three_in_triangle{Eigen::MatrixXd::Constant(2, 3, 1.0 / 6), Eigen::VectorXd::Constant(3, 1.0 / 6)};
  three_in_triangle.points(0, 1) = three_in_triangle.points(1, 2) = 2.0 / 3;
  struct Case {
    std::string name;
    CellType type;
    Integration integration;
    Quadrature calculix;
    bool same_stiffness;  // its points are those of Bielle
  };
  const std::vector<Case> cases = {
      {"C3D4", CellType::tet4, Integration::standard, simplex_quadrature(3, 1), true},
      {"C3D10", CellType::tet10, Integration::standard, simplex_quadrature(3, 2), true},
      {"C3D6", CellType::wedge6, Integration::plain, wedge_rule(one_in_triangle, 2), false},
      {"C3D15", CellType::wedge15, Integration::standard, wedge_rule(three_in_triangle, 4), false},
      {"C3D8", CellType::hex8, Integration::plain, cell_quadrature(CellType::hex8, 2), true},
      {"C3D20", CellType::hex20, Integration::standard, cell_quadrature(CellType::hex20, 4), true},
      {"C3D20R", CellType::hex20, Integration::reduced, cell_quadrature(CellType::hex20, 2), true}};
  const Material material = Material::isotropic(2e5, 0.3, 4);
  for (const Case& each : cases)
    for (const bool distorted : {false, true}) {
      if (distorted && vertex_count(each.type) == 4) continue;
      const std::string shape = each.name + (distorted ? ".distorted" : ".affine");
      CAPTURE(shape);
      const Mesh mesh = single_cell(each.type, distorted);
      const Solid solid = make_solid(mesh, {{"m", material}}, {{"all", "m"}}, each.integration);
      const NodeGraph graph = node_graph(mesh);
      const RowMatrix u = fields(mesh);
      const Eigen::MatrixXd K = u.transpose() * assemble_stiffness(solid, graph).multiply(u);
      const Eigen::MatrixXd M = u.transpose() * assemble_mass(solid, graph).multiply(u, 3);
      const Matrices same = by_points(each.type, mesh.points, material, each.calculix);
      CHECK(difference(u.transpose() * same.K * u, shape + ".K") < 1e-9);
      CHECK(difference(u.transpose() * same.M * u, shape + ".M") < 1e-9);
      if (each.same_stiffness) CHECK(difference(K, shape + ".K") < 1e-9);
      // The mass matrices of Bielle are the exact ones of affine cells.
      if (distorted) continue;
      const Matrices exact = by_points(each.type, mesh.points, material, cell_quadrature(each.type, 9));
      if (each.integration != Integration::reduced) CHECK((u.transpose() * exact.K * u - K).norm() < 1e-11 * K.norm());
      CHECK((u.transpose() * exact.M * u - M).norm() < 1e-11 * M.norm());
    }
}

TEST_CASE("Internal modes of an affine hexahedron are those of CalculiX's C3D8I") {
  const Mesh mesh = single_cell(CellType::hex8, false);
  const Solid solid = make_solid(mesh, {{"m", Material::isotropic(2e5, 0.3, 4)}}, {{"all", "m"}});
  const RowMatrix u = fields(mesh);
  CHECK(difference(u.transpose() * assemble_stiffness(solid, node_graph(mesh)).multiply(u), "C3D8I.affine.K") < 1e-9);
}

}  // namespace test_calculix_cells
