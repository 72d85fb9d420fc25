// Tests of the determinants of curved second-order tetrahedra: bounds, volume, and the definition by shape functions.
#include <array>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "reduce/mesh/jacobian.hpp"
#include "reduce/mesh/measures.hpp"
#include "tests/support/box_mesh.hpp"
#include "tests/support/random.hpp"

using namespace bielle::reduce;
using namespace bielle::test;

namespace {

Eigen::Matrix3Xd straight_tet10(Random& random) {
  Eigen::Matrix3Xd x(3, 10);
  x.leftCols<4>() << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  x.leftCols<4>() += random.matrix(3, 4, 0.2);
  for (int k = 0; k < 6; ++k) x.col(4 + k) = (x.col(tet_edges[k][0]) + x.col(tet_edges[k][1])) / 2;
  return x;
}

// Returns x(xi) by the ten shape functions L (2 L - 1), 4 L_a L_b.
Eigen::Vector3d place(const Eigen::Matrix3Xd& x, const Eigen::Vector3d& xi) {
  const Eigen::Vector4d l(1 - xi.sum(), xi[0], xi[1], xi[2]);
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (int a = 0; a < 4; ++a) result += l[a] * (2 * l[a] - 1) * x.col(a);
  for (int k = 0; k < 6; ++k) result += 4 * l[tet_edges[k][0]] * l[tet_edges[k][1]] * x.col(4 + k);
  return result;
}

// Returns the determinant by central differences, which are exact for a quadratic map up to rounding.
double determinant(const Eigen::Matrix3Xd& x, const Eigen::Vector3d& xi) {
  Eigen::Matrix3d jacobian;
  for (int k = 0; k < 3; ++k)
    jacobian.col(k) =
        (place(x, xi + 0.25 * Eigen::Vector3d::Unit(k)) - place(x, xi - 0.25 * Eigen::Vector3d::Unit(k))) / 0.5;
  return jacobian.determinant();
}

}  // namespace

TEST_CASE("all coefficients of a straight tetrahedron equal its determinant") {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Matrix3Xd x = straight_tet10(random);
    const double exact = straight_determinant(x);
    CHECK((determinant_coefficients(x).array() - exact).abs().maxCoeff() < 1e-14);
  }
}

TEST_CASE("the least and the greatest coefficient bound the determinant everywhere in the element") {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::Matrix3Xd x = straight_tet10(random);
    x.rightCols<6>() += random.matrix(3, 6, 0.15);
    const auto coefficients = determinant_coefficients(x);
    for (int sample = 0; sample < 50; ++sample) {
      Eigen::Vector4d l = random.vector(4).cwiseAbs();
      l /= l.sum();
      const double value = determinant(x, l.tail<3>());
      CHECK(value >= coefficients.minCoeff() - 1e-13);
      CHECK(value <= coefficients.maxCoeff() + 1e-13);
    }
    for (const Eigen::Vector3d& corner :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1)})
      CHECK((coefficients.array() - determinant(x, corner)).abs().minCoeff() <
            1e-13);  // the coefficients include the values at corners
  }
}

TEST_CASE("the volume of curved elements is exact") {
  // The map x -> x + a y^2 e_x has determinant 1 and is quadratic: tet10 represents it exactly, with curved sides.
  Box box;
  box.size = {1, 0.5, 0.25};
  box.bricks = {2, 3, 2};
  const auto shear = [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x + Eigen::Vector3d(0.4 * x.y() * x.y(), 0, 0));
  };
  CHECK(mesh_volume(box_mesh(box, shear)) == Approx(0.125).epsilon(1e-13));
  // The map x -> (x + a x^2, y, z) moves the end from 1 to 1 + a.
  const auto stretch = [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x.x() + 0.3 * x.x() * x.x(), x.y(), x.z());
  };
  CHECK(mesh_volume(box_mesh(box, stretch)) == Approx(1.3 * 0.125).epsilon(1e-13));
  box.quadratic = false;
  CHECK(mesh_volume(box_mesh(box)) == Approx(0.125).epsilon(1e-13));
}
