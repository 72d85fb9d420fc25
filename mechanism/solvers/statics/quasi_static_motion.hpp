// The motion of a driven mechanism whose elastic parts are in equilibrium (quasi-static elasticity): inverse dynamics
// without vibration. A. G. Erdman, G. N. Sandor, R. G. Oakberg, J. Eng. Ind. 94 (1972) 1193 (kineto-elastodynamics).
//
// Two equilibria are found at each time. The first is that under gravity, loads and the motions of drives only, F(q,
// lambda, t) = 0, at rest. The second also has the forces f of inertia and dampers in the motion, and gives
// deformations, reactions and efforts of drives. Velocities and accelerations are those along a path of such equilibria
// on which f is constant in the axes of the nodes at which it acts:
//     J [v; lambda'] = -dF/dt - f',   J [a; lambda''] = -d2F/ds2 (q + v s, lambda + lambda' s, t + s) - f'',
//     f' = omega x f,   f'' = omega x (omega x f) + omega' x f   (of forces on nodes),   J = [K B^T; B 0]
// at the deformed position: a steady rotation with its deformation is exact. Rows of constraints are exact, those of
// forces are computed by differences in s. Because f depends on v and a, and these on the deformation due to f, they
// are computed alternately. The accelerations of the deformation relative to those axes are neglected: `left_out`
// estimates them.
//
// Sought efforts (solvers/constraints/sought_efforts.hpp) are additional unknowns of each of these equations.
//
// Undetermined motions (the spin of a rod between spherical joints) stay at rest if nothing loads them.
#pragma once

#include "mechanism/solvers/statics/efforts_at_rest.hpp"
#include "mechanism/solvers/statics/equilibrium.hpp"

namespace bielle::mechanism {

class QuasiStaticMotion {
 public:
  /// @param efforts  sought efforts; must outlive this object
  /// @param step     step between two times [s]: differences use no longer one
  QuasiStaticMotion(const System& system, const Environment& environment, const SoughtEfforts& efforts, double step);
  QuasiStaticMotion(const QuasiStaticMotion&) = delete;
  QuasiStaticMotion& operator=(const QuasiStaticMotion&) = delete;

  /// Brings an assembled state to both equilibria at its time. @throws ComputationError if there is none
  void begin(State& state);
  /// Returns the state at a time. @param from  a nearby state returned by this function; @throws ComputationError if
  /// there is none
  State position(const State& from, double time);
  /// Stores the deformation due to inertia at a point, to estimate the neglected accelerations from three points at
  /// equal steps.
  void note_left_out(const State& state);
  /// Returns the largest neglected acceleration relative to the largest acceleration of a node [-].
  double left_out() const { return largest_motion_ > 0 ? largest_left_out_ / largest_motion_ : 0; }

 private:
  /// Residual (size), followed by the supports' forces along the moved directions (count of efforts).
  using Extended = VectorX;
  void find_path(const State& from, double time);
  void find_rates(State& state);
  void follow(const State& state);
  VectorX solve_rates(const State& still, Extended r, const EffortResponse& response, VectorX& effort_rate) const;
  void put_constraints(const State& state, const VectorX& rows, VectorX& r) const;
  void load_by_inertia(State& state);
  VectorX inertia_of(const State& state) const;
  VectorX weights_of_inertia(const State& state) const;
  void equilibrate(Equilibrium& equilibrium, State& state) const;
  State at_standstill(const State& state) const;
  Extended at_rest(const State& still, double after, double part) const;
  bool do_supports_move(const State& still) const;
  Extended derivative(const State& still, double part, int order) const;

  const System& system_;
  const SoughtEfforts& efforts_;
  Environment environment_, statics_;
  LoadRamp ramp_;
  EffortsAtRest path_efforts_, efforts_at_rest_;
  Equilibrium path_equilibrium_, equilibrium_;
  StaticTangent tangent_;
  std::vector<double> kinks_;
  double step_;
  bool supports_move_ = false;
  State path_;                                        ///< equilibrium of the static forces
  VectorX v_, a_, lambda_rate_, effort_rate_;         ///< derivatives along the path of equilibria
  VectorX f_, f1_, f2_;                               ///< forces of inertia and dampers (dofs), f' and f''
  MatrixX support_, support1_, support2_;             ///< their contributions to reactions of moved nodes (6, nodes)
  double largest_left_out_ = 0, largest_motion_ = 0;  ///< largest accelerations of nodes so far [m/s^2]
  std::vector<std::vector<Vector3>> deformations_;    ///< displacements of nodes due to inertia, in their axes
  std::vector<double> times_;                         ///< times of these points
};

}  // namespace bielle::mechanism
