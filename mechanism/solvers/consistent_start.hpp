// A start from which a motion can begin: positions that satisfy the constraints, velocities and accelerations that keep
// them satisfied, and the multipliers that go with the accelerations.
//
//   positions:      K dq + B^T mu = f_drawn - f(q), B dq = -Phi (repeated: Newton), K and f the elastic stiffness and
//                   forces, and a very little of unity beside K: bodies move rigidly rather than bend, and are as
//                   free of stress in the end as they were drawn
//   velocities:     [M B^T; B 0][dv; mu] = [0; -dPhi/dt]          the least change in the kinetic energy's norm
//   accelerations:  [M B^T; B 0][a; lambda] = [-g; -d2Phi/dt2 at a = 0],  first-order rates from their own equations
//
// Algebraic unknowns y, whose equations f(y, q, v, t) = 0 hold no rates, are found together with the accelerations,
// whose forces may depend on them: in [M B^T; B 0] there are then columns of y, with dg/dy, and rows of df/d(y, lambda,
// ...). Forces that depend on multipliers make the equations nonlinear: Newton's method then has
// [M B^T + df/dlambda; B 0], while velocities and everything else go by the constraints' own B^T.
#pragma once

#include <functional>
#include <string>

#include "mechanism/solvers/convergence.hpp"
#include "mechanism/solvers/mass_saddle.hpp"

namespace bielle::mechanism {

/// What the start had to change.
struct StartReport {
  double largest_displacement = 0;  ///< of a node by the assembly of positions [m]
  std::string displaced_node;       ///< that node's name
  double largest_rotation = 0;      ///< [rad]
  double velocity_change = 0;       ///< largest change of a nodal velocity [m/s]
  double impulse_work = 0;          ///< of drives and supports that bring about such a change [J]
  double settled = 0;               ///< largest displacement of a node by static equilibrium, if asked for [m]
  std::string settled_node;         ///< that node's name
  double balanced = 0;              ///< largest displacement of a node without mass, to where its forces balance [m]
  std::string balanced_node;        ///< that node's name
  std::string unbalanced;           ///< an unknown without mass whose forces could not be balanced; empty: none
  void add(const StartReport& later);
};

/// The node that has moved farthest from one state to another, where that is farther than what is noted already.
/// @param distance,node  how far [m], and its name
void note_farthest(const System& system, const State& from, const State& to, double& distance, std::string& node);

/// Moves the state's positions until all holonomic constraints hold.
/// @throws ComputationError naming the constraint that cannot be satisfied
void assemble_positions(const System& system, const Environment& environment, State& state, StartReport& report);

/// Projects the state's velocities on the constraints.
/// @param saddle  holds the factors of these positions behind it
void make_velocities_consistent(const System& system, const Environment& environment, State& state, StartReport& report,
                                MassSaddle& saddle);

/// Accelerations, multipliers, first-order rates and algebraic unknowns in equilibrium with the state's positions and
/// velocities. What has neither mass nor constraint (a node between two springs) has no acceleration of its own: it
/// gets zero.
/// Where forces depend on multipliers (friction on reactions), Newton's method finds them.
/// @param saddle  factors that serve are used, with refinement; otherwise they are made
/// @throws ComputationError naming an unknown without mass, an algebraic one that its equation does not determine, or
///         reactions for which there is no solution, or more than one (Painleve's paradox)
void make_accelerations_consistent(const System& system, const Environment& environment, State& state,
                                   MassSaddle& saddle);
void make_accelerations_consistent(const System& system, const Environment& environment, State& state);

/// All three, in that order; with them, directions without mass are balanced (massless_balance.hpp).
StartReport make_consistent(const System& system, const Environment& environment, State& state);

}  // namespace bielle::mechanism
