#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "reduce/common/error.hpp"
#include "reduce/fe/elasticity.hpp"
#include "reduce/fe/material.hpp"

using namespace bielle;
using namespace bielle::reduce;
using Catch::Contains;

TEST_CASE("The compliance of an isotropic material is that of Hooke's law") {
  const double young = 210e9, poisson = 0.3;
  const Material steel = Material::isotropic(young, poisson, 7850);
  const Eigen::Matrix<double, 6, 6> compliance = steel.elasticity.inverse();
  for (int i = 0; i < 3; ++i) {
    CHECK(compliance(i, i) == Approx(1 / young).epsilon(1e-13));
    CHECK(compliance(i, (i + 1) % 3) == Approx(-poisson / young).epsilon(1e-13));
    CHECK(compliance(3 + i, 3 + i) == Approx(2 * (1 + poisson) / young).epsilon(1e-13));
  }
  CHECK(steel.elasticity.topRightCorner<3, 3>().norm() == 0);
  CHECK(steel.density == 7850);
}

TEST_CASE("An orthotropic material has the given moduli and Poisson's ratios") {
  const Eigen::Vector3d young(140e9, 10e9, 9e9), poisson(0.4, 0.3, 0.28), shear(3e9, 4e9, 5e9);
  const Material ply = Material::orthotropic(young, poisson, shear, 1600);
  const Eigen::Matrix<double, 6, 6> s = ply.elasticity.inverse();
  for (int i = 0; i < 3; ++i) {
    CHECK(1 / s(i, i) == Approx(young(i)).epsilon(1e-13));
    CHECK(1 / s(3 + i, 3 + i) == Approx(shear(i)).epsilon(1e-13));
  }
  CHECK(-s(2, 1) / s(1, 1) == Approx(0.4).epsilon(1e-13));  // stress along y contracts z
  CHECK(-s(2, 0) / s(0, 0) == Approx(0.3).epsilon(1e-13));
  CHECK(-s(1, 0) / s(0, 0) == Approx(0.28).epsilon(1e-13));
  const Material isotropic = Material::orthotropic(Eigen::Vector3d::Constant(2.6), Eigen::Vector3d::Constant(0.3),
                                                   Eigen::Vector3d::Constant(1), 1);
  CHECK((isotropic.elasticity - Material::isotropic(2.6, 0.3, 1).elasticity).norm() < 1e-14);
}

TEST_CASE("Impossible materials are refused with a reason") {
  CHECK_THROWS_WITH(Material::isotropic(0, 0.3, 1), Contains("young must be positive"));
  CHECK_THROWS_WITH(Material::isotropic(1, 0.5, 1), Contains("poisson must lie between -1 and 0.5"));
  CHECK_THROWS_WITH(Material::isotropic(1, -1, 1), Contains("poisson"));
  CHECK_THROWS_WITH(Material::isotropic(1, 0.3, 0), Contains("density must be positive"));
  CHECK_THROWS_WITH(Material::orthotropic({1, 1, 1}, {0.9, 0.9, 0.9}, {1, 1, 1}, 1), Contains("not those of a stable"));
  Eigen::Matrix<double, 6, 6> c = Eigen::Matrix<double, 6, 6>::Identity();
  c(0, 1) = 0.1;
  CHECK_THROWS_WITH(Material::anisotropic(c, 1), Contains("must be symmetric"));
  c(1, 0) = 0.1;
  CHECK(Material::anisotropic(c, 1).elasticity == c);
  c(5, 5) = -1;
  CHECK_THROWS_AS(Material::anisotropic(c, 1), InputError);
}

TEST_CASE("Six components and tensors describe the same stress and strain") {
  const Eigen::Matrix3d h = Eigen::Matrix3d::Random();
  const Material steel = Material::isotropic(2.6, 0.3, 1);
  const Vector6 stress = steel.elasticity * strain_of(h);
  const Eigen::Matrix3d strain = (h + h.transpose()) / 2;
  const Eigen::Matrix3d expected =
      2 * strain + 1.5 * strain.trace() * Eigen::Matrix3d::Identity();  // 2 G eps + lambda tr
  CHECK((tensor_of(stress) - expected).norm() < 1e-14);
  const Eigen::Matrix<double, 9, 9> tensor = elasticity_tensor(steel.elasticity);
  Eigen::Matrix3d product = Eigen::Matrix3d::Zero();  // sigma_ij = C_ijkl h_kl
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) product(i, j) += tensor(i + 3 * k, j + 3 * l) * h(k, l);
  CHECK((product - expected).norm() < 1e-14);
}
