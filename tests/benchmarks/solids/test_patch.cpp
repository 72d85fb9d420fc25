// The patch test of MacNeal and Harder for solids, its bricks split into tetrahedra of first and second order.
//
// R. H. MacNeal, R. L. Harder, Finite Elem. Anal. Des. 1 (1985) 3: a unit cube of seven distorted bricks, the outer
// ones between the cube's faces and an inner one. Displacements u = 1e-3 (2 x + y + z) / 2, v = 1e-3 (x + 2 y + z) / 2,
// w = 1e-3 (x + y + 2 z) / 2 of the outer nodes must give the inner ones the same, and stresses of 2000 and 400.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "reduce/fe/stress.hpp"
#include "reduce/mesh/jacobian.hpp"
#include "tests/support/solid_model.hpp"

using namespace bielle;
using namespace bielle::reduce;

namespace test_patch {
namespace {

constexpr double young = 1e6, poisson = 0.25, density = 1000;

/// Returns the corners of the unit cube, then the inner brick's.
Eigen::Matrix<double, 3, 16> vertices() {
  Eigen::Matrix<double, 16, 3> x;
  x << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1,  //
      .249, .342, .192, .826, .288, .288, .850, .649, .263, .273, .750, .230,   //
      .320, .186, .643, .677, .305, .683, .788, .693, .644, .165, .745, .702;
  return x.transpose();
}

/// A brick as six tetrahedra: its first vertex with the faces that do not hold it, faces cut at their first vertex, so
/// that neighbours cut a common face alike.
void add_brick(const std::array<int, 8>& brick, std::vector<std::array<int, 4>>& tets) {
  constexpr int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  const int first = *std::min_element(brick.begin(), brick.end());
  for (const auto& face : faces) {
    std::array<int, 4> f;
    for (int k = 0; k < 4; ++k) f[k] = brick[face[k]];
    if (std::find(f.begin(), f.end(), first) != f.end()) continue;
    std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
    tets.push_back({f[0], f[2], f[1], first});  // the faces are anticlockwise seen from outside
    tets.push_back({f[0], f[3], f[2], first});
  }
}

Mesh patch(bool quadratic) {
  std::vector<std::array<int, 4>> tets;
  add_brick({8, 9, 10, 11, 12, 13, 14, 15}, tets);
  for (const std::array<int, 4>& f :
       {std::array{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}) {
    std::array<int, 8> brick;
    for (int k = 0; k < 4; ++k) {
      brick[k] = f[k] + 8;  // from the inner brick to the cube; the lower and left faces have the opposite sense
      brick[k + 4] = f[k];
    }
    add_brick(brick, tets);
  }
  std::vector<Eigen::Vector3d> points;
  const Eigen::Matrix<double, 3, 16> corners = vertices();
  for (int p = 0; p < 16; ++p) points.emplace_back(corners.col(p));
  CellBlock block{quadratic ? CellType::tet10 : CellType::tet4, {}};
  block.nodes.resize(quadratic ? 10 : 4, tets.size());
  std::map<std::pair<int, int>, int> middles;
  for (std::size_t t = 0; t < tets.size(); ++t) {
    std::array<int, 4> tet = tets[t];
    const Eigen::Vector3d a = points[tet[1]] - points[tet[0]], b = points[tet[2]] - points[tet[0]],
                          c = points[tet[3]] - points[tet[0]];
    if (a.cross(b).dot(c) < 0) std::swap(tet[0], tet[1]);
    for (int k = 0; k < 4; ++k) block.nodes(k, t) = tet[k];
    for (int k = 0; quadratic && k < 6; ++k) {
      const auto ends = std::minmax(tet[tet_edges[k][0]], tet[tet_edges[k][1]]);
      const auto [middle, is_new] = middles.emplace(ends, static_cast<int>(points.size()));
      if (is_new) points.push_back((points[ends.first] + points[ends.second]) / 2);
      block.nodes(4 + k, t) = middle->second;
    }
  }
  Mesh mesh;
  mesh.points.resize(3, points.size());
  for (std::size_t p = 0; p < points.size(); ++p) mesh.points.col(p) = points[p];
  mesh.blocks.push_back(block);
  return mesh;
}

bool is_outside(const Eigen::Vector3d& x) { return x.minCoeff() < 1e-12 || x.maxCoeff() > 1 - 1e-12; }

}  // namespace

TEST_CASE("The patch test of MacNeal and Harder: constant stress through distorted cells of both orders") {
  Eigen::Matrix3d gradient;
  gradient << 2, 1, 1, 1, 2, 1, 1, 1, 2;
  gradient *= 0.5e-3;
  for (const bool quadratic : {false, true}) {
    CAPTURE(quadratic);
    const test::SolidModel model(patch(quadratic), Material::isotropic(young, poisson, density),
                                 [](const Eigen::Vector3d& x, int) { return is_outside(x); });
    const Eigen::Index points = model.mesh.point_count();
    RowMatrix prescribed = RowMatrix::Zero(3 * points, 1);
    Eigen::VectorXd exact(3 * points);
    for (Eigen::Index p = 0; p < points; ++p) {
      const Eigen::Vector3d u = gradient * model.mesh.points.col(p);
      exact.segment<3>(3 * p) = u;
      if (is_outside(model.mesh.points.col(p))) prescribed.middleRows<3>(3 * p) = u;
    }
    const RowMatrix forces = -model.stiffness.multiply(prescribed, 1);
    const RowMatrix u = prescribed + model.solve(forces);
    CHECK((u - exact).cwiseAbs().maxCoeff() < 1e-15);  // relative to 2e-3
    std::vector<int> nodes(points);
    for (int p = 0; p < points; ++p) nodes[p] = p;
    const RowMatrix stress = nodal_stress(model.solid, u, nodes);
    double error = 0;
    for (int p = 0; p < points; ++p)
      for (int i = 0; i < 6; ++i) error = std::max(error, std::abs(stress(6 * p + i) - (i < 3 ? 2000 : 400)));
    CHECK(error < 1e-8);
  }
}

TEST_CASE("The patch has the mass, centre and inertia of the cube") {
  for (const bool quadratic : {false, true}) {
    const Mesh mesh = patch(quadratic);
    const MassProperties found =
        mass_properties(make_solid(mesh, {{"m", Material::isotropic(young, poisson, density)}}, {{"all", "m"}}));
    CHECK(found.mass == Approx(density).epsilon(1e-14));
    CHECK((found.centre - Eigen::Vector3d::Constant(0.5)).norm() < 1e-14);
    CHECK((found.inertia - density / 6 * Eigen::Matrix3d::Identity()).norm() < 1e-12 * density);
  }
}

}  // namespace test_patch
