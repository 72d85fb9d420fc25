// Motions of a reduced body split into their rigid part and a rest without momentum, and inertia components joined from
// both. The rigid part of M~ is known exactly, whatever is known of the inside.
#pragma once

#include <array>

#include <Eigen/Core>

#include "reduce/reduction/checks.hpp"

namespace bielle::reduce {

/// q = U r + d with U^T M~ d = 0; r are three translations and three rotations about the centre, body axes.
struct RigidSplit {
  Eigen::MatrixXd rigid;                                ///< U (N,6)
  Eigen::MatrixXd rates;                                ///< r in terms of q (6,N)
  Eigen::MatrixXd rest;                                 ///< d in terms of q (N,N)
  double mass = 0;                                      ///< [kg]
  Eigen::Matrix3d second;                               ///< P = integral of rho x x^T about the centre [kg m^2]
  Eigen::Matrix3d axes;                                 ///< its principal axes -> body axes
  Eigen::Vector3d principal = Eigen::Vector3d::Zero();  ///< P along these, ascending, not negative [kg m^2]
};

RigidSplit split_rigid(const Eigen::MatrixXd& mass, const MassProperties& body, const Eigen::MatrixXd& rigid);

/// N_kl = integral of rho d_k x_l for each coordinate (N), symmetric in k and l.
using RestMoments = std::array<std::array<Eigen::RowVectorXd, 3>, 3>;

/// S_kl of the rest d alone, as far as they are known, so that they add up to M~ of the rest.
struct RestInertia {
  std::array<Eigen::MatrixXd, 6> components;  ///< (N,N)
  RestMoments moments;
  Eigen::MatrixXd open;  ///< part of the rest's M~ without known directions (N,N); each direction got a third of it
};

/// Tells whether the kinetic energy is not negative in any direction. It is negative for matrices of beams whose only
/// rotary inertia is that of torsion, since no cloud of mass has an inertia about a single axis.
bool is_semidefinite(const std::array<Eigen::MatrixXd, 6>& components);

/// Returns the rest of components that may not add up to M~. In the basis of M~ and their sum (eigenvalues l, 1 if they
/// add up) motions with l above one half are scaled by l^-1/2, the others get the missing 1 - l in thirds. Components
/// with a negative energy are not used.
RestInertia rest_inertia(const std::array<Eigen::MatrixXd, 6>& components, const Eigen::MatrixXd& mass,
                         const RigidSplit& split);

/// S_11 S_22 S_33 S_23 S_13 S_12 of rigid part and rest together. The linear field nearest to the rest follows from its
/// moments; what remains of the energy has the directions of the rest's components.
std::array<Eigen::MatrixXd, 6> joined_inertia(const RigidSplit& split, const RestInertia& rest,
                                              const Eigen::MatrixXd& mass);

/// Returns components that add up to M~ exactly, from those that do so except for the digits of a text file.
std::array<Eigen::MatrixXd, 6> normalised_inertia(const std::array<Eigen::MatrixXd, 6>& components,
                                                  const Eigen::MatrixXd& mass);

/// Returns the moments A^T N A along axes A.
RestMoments turned_moments(const RestMoments& moments, const Eigen::Matrix3d& axes);

}  // namespace bielle::reduce
