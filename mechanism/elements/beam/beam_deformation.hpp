// Deformation of a beam element at a state, as its forces, tangent and measures need it. (Symbols: beam_element.hpp.)
#pragma once

#include "mechanism/elements/beam/beam_element.hpp"

namespace bielle::mechanism {

using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix6x12 = Eigen::Matrix<double, 6, 12>;

/// Resultants at a section of an element with relative motion d in equilibrium, as a function of its f: the nodal
/// wrench at B, T6^-T(d) f, transferred to the section. @param section  frame of the section in the axes of the section
/// frame at B
inline Matrix6 equilibrium(const Vector6& d, const Frame& section) {
  return adjoint(section).transpose() * tangent_se3_inverse(d).transpose();
}

/// Section frames, relative frame, and derived quantities.
struct BeamElement::Deformation {
  Matrix3 R_A, R_B;  ///< section axes -> inertial
  Vector6 d;
  Matrix6x12 P;
  Vector12 v;  ///< body velocities of the section frames
  BeamBowing::Stretch bowing;
  Matrix6x12 S;  ///< J P
  Vector6 eps, epsdot;
  Vector6 f;  ///< resultants of the strains

  /// Returns J^T times the resultants of the strains: the forces conjugate to e.
  Vector6 of_motion(const Vector6& resultants, const Vector3& along) const {
    return resultants + bowing.gradient * along.dot(resultants.head<3>());
  }
};

}  // namespace bielle::mechanism
