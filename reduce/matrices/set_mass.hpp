// Mass properties of a mass matrix under rigid motions.
#pragma once

#include <Eigen/Core>

#include "reduce/matrices/matrix_study.hpp"

namespace bielle::reduce {

struct SetMass {
  Eigen::Vector3d along = Eigen::Vector3d::Zero();      ///< mass against accelerations along x, y, z [kg]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();     ///< [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();    ///< about the centre, body axes [kg m^2]
  Eigen::Matrix3d at_origin = Eigen::Matrix3d::Zero();  ///< about the origin
  /// Largest entry that the mass matrix of a rigid body does not have, relative to the mass: coupling of mass between
  /// two directions, or the symmetric part of the coupling of mass and moment, divided by the length of the body.
  double odd = 0;

  double mass() const { return along.mean(); }
  Eigen::Vector3d principal() const;  ///< moments about the centre, ascending
  /// Sides of the box of uniform density with this mass and inertia [m].
  Eigen::Vector3d box() const;
};

/// @param study  with geometric motions
SetMass mass_of(const MatrixStudy& study);

}  // namespace bielle::reduce
