// Deformation of a beam element at a state, as its forces, tangent and measures need it. (Symbols: beam_element.hpp.)
#pragma once

#include "mechanism/elements/beam/beam_element.hpp"

namespace bielle::mechanism {

using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix6x12 = Eigen::Matrix<double, 6, 12>;
using Matrix12x6 = Eigen::Matrix<double, 12, 6>;

/// Resultants at a section of an element with relative motion d in equilibrium, as a function of its f: the nodal
/// wrench at B, T6^-T(d) f, transferred to the section. @param section  frame of the section in the axes of the section
/// frame at B
inline Matrix6 equilibrium(const Vector6& d, const Frame& section) {
  return adjoint(section).transpose() * tangent_se3_inverse(d).transpose();
}

/// Section frames, relative frame and strain: all that the elastic energy needs.
struct BeamElement::Strain {
  Matrix3 R_A, R_B;  ///< section axes -> inertial
  Vector6 d;
  BeamBowing::Stretch bowing;
  Vector6 eps;

  /// Returns J times a rate of e: the rate of eps.
  Vector6 of_strain(const Vector6& rate, const Vector3& along) const {
    Vector6 all = rate;
    all.head<3>() += bowing.gradient.dot(rate) * along;
    return all;
  }
  /// Returns J^T times the resultants of the strains: the forces conjugate to e.
  Vector6 of_motion(const Vector6& resultants, const Vector3& along) const {
    return resultants + bowing.gradient * along.dot(resultants.head<3>());
  }
};

/// The strain, its gradient, its rate and the forces.
struct BeamElement::Deformation : Strain {
  Matrix12x6 PT;   ///< P^T in the axes of the nodes: dd = P [dx_A; dTheta_A; dx_B; dTheta_B]
  Vector6 epsdot;  ///< 0 in an element without damping
  Vector6 f;       ///< resultants of the strains
};

}  // namespace bielle::mechanism
