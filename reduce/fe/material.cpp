#include "reduce/fe/material.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <fmt/format.h>

#include "reduce/common/error.hpp"
#include "reduce/dense/symmetric_factors.hpp"
#include "reduce/fe/elasticity.hpp"

namespace bielle::reduce {

namespace {

void check_density(double density) {
  if (!(density > 0)) {
    throw InputError(fmt::format("density must be positive, not {} kg/m^3", density));
  }
}

/// Refuses constants with which some strain would have negative energy.
void check_positive_definite(const Eigen::Matrix<double, 6, 6>& elasticity, const char* constants) {
  if (!elasticity.allFinite() || !is_positive_definite(elasticity)) {
    throw InputError(fmt::format(
        "{} are not those of a stable material (the elasticity matrix is not positive definite)", constants));
  }
}

}  // namespace

Eigen::Matrix3d Material::axes_at(const Eigen::Vector3d& place) const {
  const Eigen::Vector3d arm = place - winding_point;
  const Eigen::Vector3d across = arm - winding_axis.dot(arm) * winding_axis;
  Eigen::Matrix3d axes;
  axes.col(0) = across / across.norm();
  axes.col(2) = winding_axis;
  axes.col(1) = winding_axis.cross(axes.col(0));
  return axes;
}

Eigen::Matrix<double, 6, 6> Material::elasticity_at(const Eigen::Vector3d& place) const {
  return is_wound() ? rotate_elasticity(elasticity, axes_at(place)) : elasticity;
}

Material Material::isotropic(double young, double poisson, double density) {
  if (!(young > 0)) {
    throw InputError(fmt::format("young must be positive, not {} Pa", young));
  }
  if (!(poisson > -1 && poisson < 0.5)) {
    throw InputError(fmt::format("poisson must lie between -1 and 0.5 (both excluded), not be {}", poisson));
  }
  check_density(density);
  const double shear = young / (2 * (1 + poisson));
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  Material material;
  material.density = density;
  material.elasticity.setZero();
  material.elasticity.topLeftCorner<3, 3>().setConstant(lambda);
  material.elasticity.diagonal().head<3>().array() += 2 * shear;
  material.elasticity.diagonal().tail<3>().setConstant(shear);
  return material;
}

Material Material::orthotropic(const Eigen::Vector3d& young, const Eigen::Vector3d& poisson,
                               const Eigen::Vector3d& shear, double density) {
  if (!(young.minCoeff() > 0)) {
    throw InputError("every value of young must be positive");
  }
  if (!(shear.minCoeff() > 0)) {
    throw InputError("every value of shear must be positive");
  }
  check_density(density);
  Eigen::Matrix3d compliance = young.cwiseInverse().asDiagonal();
  compliance(1, 2) = compliance(2, 1) = -poisson(0) / young(1);
  compliance(0, 2) = compliance(2, 0) = -poisson(1) / young(0);
  compliance(0, 1) = compliance(1, 0) = -poisson(2) / young(0);
  Material material;
  material.density = density;
  material.elasticity.setZero();
  const Eigen::Matrix3d normal = compliance.inverse();
  material.elasticity.topLeftCorner<3, 3>() = (normal + normal.transpose()) / 2;
  material.elasticity.diagonal().tail<3>() = shear;
  check_positive_definite(material.elasticity, "these orthotropic constants");
  return material;
}

Material Material::anisotropic(const Eigen::Matrix<double, 6, 6>& elasticity, double density) {
  check_density(density);
  const double asymmetry = (elasticity - elasticity.transpose()).cwiseAbs().maxCoeff();
  if (!(asymmetry <= 1e-9 * elasticity.cwiseAbs().maxCoeff())) {
    throw InputError(fmt::format("the elasticity matrix must be symmetric; entries differ by {:.3g} Pa", asymmetry));
  }
  check_positive_definite(elasticity, "these anisotropic constants");
  Material material;
  material.elasticity = (elasticity + elasticity.transpose()) / 2;
  material.density = density;
  return material;
}

}  // namespace bielle::reduce
