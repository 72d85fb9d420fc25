// Equilibrium in steady rotation: all free parts rotate with one angular velocity, deformed by their own inertia.
//
// With v = w x (x - c), a = w x v and Omega = R^T w of every free node, the equations of motion are equations for the
// positions and multipliers; Newton's method uses the linearised equations in rotating axes at s = 0.
#pragma once

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

struct SteadyRotation {
  Vector3 omega = Vector3::Zero();    ///< angular velocity [rad/s], inertial
  Vector3 through = Vector3::Zero();  ///< a point of the axis [m]
};

/// Moves a state to this equilibrium, with its rates, accelerations and multipliers; first with the whole speed,
/// otherwise in steps of the speed.
/// @throws ComputationError if no equilibrium is found, or if joints, drives or supports do not permit this rotation
void settle_in_rotation(const System& system, const Environment& environment, const SteadyRotation& rotation,
                        State& state);

}  // namespace bielle::mechanism
