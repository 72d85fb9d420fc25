// The motion of a driven mechanism whose elastic parts follow in equilibrium (quasi-static elasticity): inverse
// dynamics without vibration. A. G. Erdman, G. N. Sandor, R. G. Oakberg, J. Eng. Ind. 94 (1972) 1193
// (kineto-elastodynamics).
//
// At each time two equilibria are found. The first is that under gravity, loads and the motions of drives alone, F(q,
// lambda, t) = 0, at rest. The second has the inertia forces and dampers' forces f of the motion as well, and tells
// deformations, reactions and efforts of drives. Velocities and accelerations are those along a path of such equilibria
// on which f stays as it is in the axes of the nodes that it acts at:
//     J [v; lambda'] = -dF/dt - f',   J [a; lambda''] = -d2F/ds2 (q + v s, lambda + lambda' s, t + s) - f'',
//     f' = omega x f,   f'' = omega x (omega x f) + omega' x f   (of forces on nodes),   J = [K B^T; B 0]
// at the deformed position: what turns steadily with its deformation is exact. Rows of constraints are exact, those of
// forces differences in s. As f follows from v and a, and they from where f deforms to, all are found by turns. Left
// out are the accelerations of the deformation relative to those axes: `left_out` estimates them.
//
// Efforts that are sought (solvers/constraints/sought_efforts.hpp) are further unknowns of each of these equations.
//
// Motions that nothing determines (the spin of a rod between spherical joints) stay at rest where nothing loads them.
#pragma once

#include "mechanism/solvers/statics/efforts_at_rest.hpp"
#include "mechanism/solvers/statics/equilibrium.hpp"

namespace bielle::mechanism {

class QuasiStaticMotion {
 public:
  /// @param efforts  that are sought; it must outlive this
  /// @param step     between two times [s]: differences look no farther
  QuasiStaticMotion(const System& system, const Environment& environment, const SoughtEfforts& efforts, double step);
  QuasiStaticMotion(const QuasiStaticMotion&) = delete;
  QuasiStaticMotion& operator=(const QuasiStaticMotion&) = delete;

  /// Brings an assembled state into both equilibria at its time. @throws ComputationError when there is none
  void begin(State& state);
  /// The state at a time. @param from  nearby, as this has given it; @throws ComputationError when there is none
  State position(const State& from, double time);
  /// Notes what inertia deforms at a point, to estimate the accelerations that are left out from three points at equal
  /// steps.
  void note_left_out(const State& state);
  /// The largest of these over the largest acceleration of a node [-].
  double left_out() const { return largest_motion_ > 0 ? largest_left_out_ / largest_motion_ : 0; }

 private:
  /// Residual (size), with the supports' forces along the moved directions behind it (count of efforts).
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
  State path_;                                 ///< equilibrium of what acts at rest
  VectorX v_, a_, lambda_rate_, effort_rate_;  ///< along the path of equilibria
  VectorX f_, f1_, f2_;                        ///< inertia and dampers' forces (dofs), f' and f''
  MatrixX support_, support1_, support2_;      ///< what they make of reactions of moved nodes (6, nodes), likewise
  double largest_left_out_ = 0, largest_motion_ = 0;  ///< accelerations of nodes so far [m/s^2]
  std::vector<std::vector<Vector3>> deformations_;    ///< of the nodes by inertia, in their axes, at the last points
  std::vector<double> times_;                         ///< of them
};

}  // namespace bielle::mechanism
