// Equilibrium in steady rotation: all free parts rotate with one angular velocity, or the part behind a joint does
// while the rest stands still, deformed by their own inertia.
//
// With v = w x (x - c), a = w x v and Omega = R^T w of every free node, the equations of motion are equations for the
// positions and multipliers; Newton's method uses the linearised equations in rotating axes at s = 0. Forces on a
// mechanism with a standing part are means over a turn (mean_forces.hpp), and its axis moves with the standing part.
#pragma once

#include <cstddef>
#include <optional>

#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

struct SteadyRotation {
  Vector3 omega = Vector3::Zero();    ///< angular velocity [rad/s], inertial
  Vector3 through = Vector3::Zero();  ///< a point of the axis [m]
  /// Member of the model behind which a part turns; empty: everything turns.
  std::optional<std::size_t> joint = {};
  double rate = 0;  ///< rate of the joint's angle [rad/s]; `omega` and `through` are not used then
  /// Behind a joint: whether small motions are about the mean state, without the vibrations that gravity across the
  /// axis and unbalance excite.
  bool mean = false;
};

/// Moves a state to this equilibrium, with its rates, accelerations and multipliers; first with the whole speed,
/// otherwise in steps of the speed.
/// @throws ComputationError if no equilibrium is found, or if joints, drives or supports do not permit this rotation
void settle_in_rotation(const System& system, const Environment& environment, const SteadyRotation& rotation,
                        State& state);

}  // namespace bielle::mechanism
