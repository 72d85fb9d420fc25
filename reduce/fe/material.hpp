// Linear elastic materials.
#pragma once

#include <Eigen/Core>

namespace bielle::reduce {

/// Elastic constants and density. Stress and strain in the order xx yy zz yz xz xy, engineering shear strains.
///
/// The axes of a wound material turn with the place around a line: its x is radial, y points around the line, z along
/// it. A cell has the axes of its centroid, so that the angle between neighbouring cells should be small.
struct Material {
  Eigen::Matrix<double, 6, 6> elasticity;  ///< C [Pa], symmetric positive definite, axes of the body or the wound ones
  double density = 0;                      ///< [kg/m^3]
  Eigen::Vector3d winding_point = Eigen::Vector3d::Zero();  ///< on the line of a wound material [m]
  Eigen::Vector3d winding_axis = Eigen::Vector3d::Zero();   ///< unit direction of the line; zero: axes of the body

  bool is_wound() const { return winding_axis != Eigen::Vector3d::Zero(); }
  /// Returns the axes of a wound material at a place, in columns: radial, around, along; NaN on the line itself.
  Eigen::Matrix3d axes_at(const Eigen::Vector3d& place) const;
  /// Returns C at a place, body axes.
  Eigen::Matrix<double, 6, 6> elasticity_at(const Eigen::Vector3d& place) const;

  /// @param young > 0 [Pa]; @param poisson in (-1, 0.5); @param density > 0 [kg/m^3]. @throws InputError
  static Material isotropic(double young, double poisson, double density);

  /// Three planes of symmetry, normal to the body axes.
  /// @param young    E_x E_y E_z > 0 [Pa]
  /// @param poisson  nu_yz nu_xz nu_xy: contraction along the second axis by stress along the first, so that
  ///                 nu_yz / E_y = nu_zy / E_z
  /// @param shear    G_yz G_xz G_xy > 0 [Pa]
  /// @throws InputError when a modulus is not positive or the constants do not make a positive energy
  static Material orthotropic(const Eigen::Vector3d& young, const Eigen::Vector3d& poisson,
                              const Eigen::Vector3d& shear, double density);

  /// @param elasticity  C [Pa] in the order xx yy zz yz xz xy, symmetric positive definite. @throws InputError
  static Material anisotropic(const Eigen::Matrix<double, 6, 6>& elasticity, double density);
};

}  // namespace bielle::reduce
