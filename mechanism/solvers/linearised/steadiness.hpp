// Steadiness of the linearised equations of a moving state: whether they keep their coefficients, and in which axes.
//
// Modes are meaningful if they do: at rest, and in steady motions in suitable axes. The state is advanced by a short
// time along its velocities and accelerations; the shift-inverted operators of both instants are compared on states of
// the first that are moved with the axes. (The operator, unlike the equations, does not depend on the choice of the
// rows of constraints by the components.)
#pragma once

#include <optional>

#include "mechanism/solvers/linearised/equations.hpp"

namespace bielle::mechanism {

struct Steadiness {
  /// Rate of the motion [1/s], from the largest angular velocity, the largest velocity divided by the mechanism's size,
  /// and accelerations.
  double rate = 0;
  double inertial = 0;  ///< relative rate of change of the equations in inertial axes [1/s]
  double turning = 0;   ///< relative rate of change in axes that rotate with the nodes [1/s]
  double least() const { return inertial < turning ? inertial : turning; }
  double change(ModeAxes axes) const { return axes == ModeAxes::turning ? turning : inertial; }
  /// Returns the inertial axes, unless these are worse, or the rotating ones are exact and these are not: a slightly
  /// unbalanced rotor would seem to be unstable in the others.
  ModeAxes axes() const;
  /// Whether the equations change by less than a thousandth while the motion proceeds by a radian or its size.
  bool steady() const;
  bool steady_in(ModeAxes axes) const;
  /// Relative change of the equations in this time, if it counts as steady; otherwise 0.
  double drift(ModeAxes axes) const;
};

/// Computes the steadiness at a state whose accelerations and multipliers are consistent with its velocities. There is
/// no value if it is at rest, or so slow that velocities do not matter.
std::optional<Steadiness> find_steadiness(const System& system, const Environment& environment, const State& state);

/// A force, or moment, that keeps its direction while the mechanism turns.
struct StandingForce {
  double size = 0;  ///< its part across the axis [N], [N m]
  int node = -1;
  bool moment = false;
};

/// Returns the largest force at a node that does not turn with a mechanism in steady rotation as a whole, relative to
/// the acting forces: the mechanism is turned by a right angle, and the change of its accelerations is multiplied by
/// the masses. There is no value if rounding explains it.
/// @param omega  [rad/s] @param through  point of the axis [m]
std::optional<StandingForce> standing_force(const System& system, const Environment& environment, const State& state,
                                            const Vector3& omega, const Vector3& through);

/// Returns the largest inertial force of a state at rest relative to the largest acting force: zero in equilibrium.
/// @param equation  receives the equation with the largest force
double unbalance(const System& system, const Environment& environment, const State& state, int& equation);

}  // namespace bielle::mechanism
