// Whether the linearised equations of a moving state keep their coefficients, and in which axes.
//
// Modes have a meaning where they do: at rest, and in steady motions seen in the right axes. The state is moved on by a
// short time along its velocities and accelerations; the shift-inverted operators of both instants are compared on
// states of the first that are carried along by the axes. (The operator, unlike the equations, does not depend on how
// the components choose the rows of their constraints.)
#pragma once

#include <optional>

#include "mechanism/solvers/linearised/equations.hpp"

namespace bielle::mechanism {

struct Steadiness {
  /// Of the motion [1/s]: by the largest angular velocity, velocity over the mechanism's size, and accelerations alike.
  double rate = 0;
  double inertial = 0;  ///< how fast the equations change in inertial axes [1/s], relative to themselves
  double turning = 0;   ///< the same in axes that turn with the nodes
  double least() const { return inertial < turning ? inertial : turning; }
  double change(ModeAxes axes) const { return axes == ModeAxes::turning ? turning : inertial; }
  /// Inertial ones, unless these are worse, or turning ones exact where these are not: a slightly unbalanced rotor
  /// would seem to be unstable in the others.
  ModeAxes axes() const;
  /// Whether the equations change by less than a thousandth while the motion goes on by a radian or its size.
  bool steady() const;
  bool steady_in(ModeAxes axes) const;
  /// By what part they change meanwhile, if that counts as steady; otherwise 0.
  double drift(ModeAxes axes) const;
};

/// Of a state whose accelerations and multipliers belong to its velocities. Nothing where it is at rest,
/// or so slow that velocities do not matter.
std::optional<Steadiness> find_steadiness(const System& system, const Environment& environment, const State& state);

/// The largest acceleration force of a state at rest relative to the largest force that acts: zero in equilibrium.
/// @param equation  receives the equation with the largest
double unbalance(const System& system, const Environment& environment, const State& state, int& equation);

}  // namespace bielle::mechanism
