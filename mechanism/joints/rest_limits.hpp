// Rounding limits of the rate and acceleration of a coordinate: below them a joint is at rest.
#pragma once

#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

/// Returns the error of a velocity [m/s] of two nodes' relative motion. @param of_joint  state of a joint of two nodes
/// @param arm  lever arm of angular rates [m]; 1 gives the error of an angular rate [rad/s] as well
inline double velocity_at_rest(const LocalState& of_joint, double arm) {
  const NodeState &first = of_joint.node(0), &second = of_joint.node(1);
  // Error of velocities that the rounding of positions causes within a step, independent of the size of the velocities.
  constexpr double per_second = 1e-11;
  return 1e-12 * (first.v.norm() + second.v.norm() + arm * (first.Omega.norm() + second.Omega.norm())) +
         per_second * (first.x.norm() + second.x.norm() + arm);
}

/// Returns the error of an acceleration [m/s^2] likewise.
inline double acceleration_at_rest(const LocalState& of_joint, double arm) {
  const NodeState &first = of_joint.node(0), &second = of_joint.node(1);
  return 1e-9 * (of_joint.environment().gravity.norm() + first.a.norm() + second.a.norm() +
                 arm * (first.Omegadot.norm() + second.Omegadot.norm()));
}

}  // namespace bielle::mechanism
