#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "reduce/fe/stress.hpp"
#include "tests/support/box_mesh.hpp"

using namespace bielle;
using namespace bielle::reduce;

TEST_CASE("Linear stress fields are recovered exactly at the nodes of a distorted mesh") {
  // The field is Saint-Venant's bending about z with unit curvature: sigma_xx = -E y.
  const double nu = 0.3, young = 2e5;
  const Mesh mesh = test::distorted_box_mesh({{1, 1, 1}, {3, 2, 3}}, 0.25);
  const Solid solid = make_solid(mesh, {{"m", Material::isotropic(young, nu, 1)}}, {{"all", "m"}});
  RowMatrix u(3 * mesh.point_count(), 2);
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a) {
    const Eigen::Vector3d x = mesh.points.col(a);
    u.block<3, 1>(3 * a, 0) =
        Eigen::Vector3d(-x.x() * x.y(), (x.x() * x.x() + nu * (x.y() * x.y() - x.z() * x.z())) / 2, nu * x.y() * x.z());
    u.block<3, 1>(3 * a, 1) = Eigen::Vector3d(x.y(), 0, 0);  // simple shear
  }
  std::vector<int> nodes(mesh.point_count());
  std::iota(nodes.begin(), nodes.end(), 0);
  const RowMatrix stress = nodal_stress(solid, u, nodes, 2);
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a) {
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(6, 2);
    expected(0, 0) = -young * mesh.points(1, a);
    expected(5, 1) = young / (2 * (1 + nu));
    CHECK((stress.middleRows<6>(6 * a) - expected).norm() < 1e-11 * young);
  }
  const std::vector<int> some{3, 17, 40};
  const RowMatrix part = nodal_stress(solid, u, some, 1);
  for (int r = 0; r < 3; ++r) {
    CHECK((part.middleRows<6>(6 * r) - stress.middleRows<6>(6 * some[r])).norm() < 1e-13 * young);
  }
}

TEST_CASE("Surface nodes are the nodes of faces that belong to one cell only") {
  const bool quadratic = GENERATE(true, false);
  const Mesh mesh = test::box_mesh({{1, 1, 1}, {3, 2, 4}, quadratic});
  const Solid solid = make_solid(mesh, {{"m", Material::isotropic(1, 0, 1)}}, {{"all", "m"}});
  std::vector<int> expected;
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a) {
    if ((mesh.points.col(a).array() == 0).any() || (mesh.points.col(a).array() == 1).any()) {
      expected.push_back(static_cast<int>(a));
    }
  }
  CHECK(surface_nodes(solid) == expected);
}

TEST_CASE("The nodal stress between cells of one material is their mean, weighted by volume") {
  // Two layers are 0.2 and 0.8 thick; only the first one is strained, with a stress of 1 Pa.
  const Mesh mesh = test::box_mesh({{1, 1, 1}, {2, 1, 1}, false}, [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x() < 0.5 ? 0.4 * x.x() : 0.2 + 1.6 * (x.x() - 0.5), x.y(), x.z());
  });
  const Solid solid = make_solid(mesh, {{"m", Material::isotropic(1, 0, 1)}}, {{"all", "m"}});
  RowMatrix u = RowMatrix::Zero(3 * mesh.point_count(), 1);
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a) u(3 * a) = std::min(mesh.points(0, a), 0.2);
  std::vector<int> nodes(static_cast<std::size_t>(mesh.point_count()));
  std::iota(nodes.begin(), nodes.end(), 0);
  std::vector<double> strained(nodes.size()), all(nodes.size());
  const Eigen::MatrixXi cells = mesh.blocks[0].nodes;
  for (Eigen::Index e = 0; e < cells.cols(); ++e) {
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = mesh.points.col(cells(k + 1, e)) - mesh.points.col(cells(0, e));
    const double volume = std::abs(edges.col(0).cross(edges.col(1)).dot(edges.col(2))) / 6;
    const bool first = mesh.points(0, cells.col(e)).maxCoeff() < 0.3;
    for (int k = 0; k < 4; ++k) {
      all[static_cast<std::size_t>(cells(k, e))] += volume;
      if (first) strained[static_cast<std::size_t>(cells(k, e))] += volume;
    }
  }
  const RowMatrix stress = nodal_stress(solid, u, nodes);
  for (const int a : nodes)
    CHECK(stress(6 * a) ==
          Approx(strained[static_cast<std::size_t>(a)] / all[static_cast<std::size_t>(a)]).margin(1e-13));
}

TEST_CASE("The stress at a node between two materials is that of the material with more volume there") {
  Mesh mesh = test::box_mesh({{3, 1, 1}, {3, 1, 1}});
  Group stiff{3, {{CellType::tet10, {}}}, {}};
  for (Eigen::Index e = 0; e < mesh.blocks[0].nodes.cols(); ++e) {
    if (mesh.points(0, mesh.blocks[0].nodes.col(e)).minCoeff() > 0.9) {
      stiff.parts[0].cells.push_back(static_cast<int>(e));
    }
  }
  mesh.groups["stiff"] = stiff;
  const Solid solid = make_solid(mesh, {{"a", Material::isotropic(1, 0, 1)}, {"b", Material::isotropic(10, 0, 1)}},
                                 {{"all", "a"}, {"stiff", "b"}});
  RowMatrix u = RowMatrix::Zero(3 * mesh.point_count(), 1);
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a) {
    u(3 * a) = mesh.points(0, a);
  }
  std::vector<int> nodes(mesh.point_count());
  std::iota(nodes.begin(), nodes.end(), 0);
  const RowMatrix stress = nodal_stress(solid, u, nodes);
  for (Eigen::Index a = 0; a < mesh.point_count(); ++a) {
    const double x = mesh.points(0, a);
    if (std::abs(x - 1) > 1e-9) {
      CHECK(stress(6 * a) == Approx(x < 1 ? 1 : 10).epsilon(1e-12));
    } else {
      CHECK((std::abs(stress(6 * a) - 1) < 1e-12 || std::abs(stress(6 * a) - 10) < 1e-11));  // not a mean
    }
  }
}
