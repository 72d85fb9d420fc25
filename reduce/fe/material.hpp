// Linear elastic materials.
#pragma once

#include <Eigen/Core>

namespace bielle::reduce {

/// Elastic constants and density. Stress and strain in the order xx yy zz yz xz xy, engineering shear strains.
struct Material {
  Eigen::Matrix<double, 6, 6> elasticity;  ///< C [Pa], symmetric positive definite, body axes
  double density = 0;                      ///< [kg/m^3]

  /// @param young > 0 [Pa]; @param poisson in (-1, 0.5); @param density > 0. @throws InputError
  static Material isotropic(double young, double poisson, double density);
};

}  // namespace bielle::reduce
