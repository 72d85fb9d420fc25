// Equilibrium in steady rotation: all that is free turns with one angular velocity, deformed by its own inertia.
//
// With v = w x (x - c), a = w x v and Omega = R^T w of every free node, the equations of motion are equations of the
// positions and multipliers; Newton's method has the linearised equations in turning axes at s = 0.
#pragma once

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

struct SteadyRotation {
  Vector3 omega = Vector3::Zero();    ///< [rad/s], inertial
  Vector3 through = Vector3::Zero();  ///< a point of the axis [m]
};

/// Moves a state there, with its rates, accelerations and multipliers; at first as a whole, then in steps of the speed.
/// @throws ComputationError  where no equilibrium is found; where joints, drives or supports do not let everything turn
/// so
void settle_in_rotation(const System& system, const Environment& environment, const SteadyRotation& rotation,
                        State& state);

}  // namespace bielle::mechanism
