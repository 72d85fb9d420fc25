// The motion of a driven mechanism whose elastic parts follow in equilibrium (quasi-static elasticity): inverse
// dynamics without vibration. A. G. Erdman, G. N. Sandor, R. G. Oakberg, J. Eng. Ind. 94 (1972) 1193
// (kineto-elastodynamics).
//
// At each time two equilibria are found. The first, under gravity, loads and the motions of drives alone, F(q, lambda,
// t) = 0, tells velocities and accelerations: along the path of such equilibria
//     J [v; lambda'] = -dF/dt,   J [a; lambda''] = -d2F/ds2 (q + v s, lambda + lambda' s, t + s),   J = [K B^T; B 0].
// Rows of constraints are exact, those of forces differences in s. The
// second equilibrium has the inertia forces and dampers' forces of these rates as well, and tells deformations,
// reactions and efforts of drives. Left out are the accelerations of the deformation that inertia itself causes:
// `left_out` estimates them.
//
// Motions that nothing determines (the spin of a rod between spherical joints) stay at rest where nothing loads them.
#pragma once

#include "mechanism/solvers/constraints/mass_saddle.hpp"
#include "mechanism/solvers/statics/equilibrium.hpp"

namespace bielle::mechanism {

class QuasiStaticMotion {
 public:
  /// @param step  between two times [s]: differences look no farther
  QuasiStaticMotion(const System& system, const Environment& environment, double step);
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
  void find_path(const State& from, double time);
  void find_rates();
  void put_constraints(const State& state, const VectorX& rows, VectorX& r) const;
  void take_rates(State& state);
  void load_by_inertia(State& state);
  VectorX inertia_forces(const State& state) const;
  VectorX at_rest(double after, double part) const;
  bool do_supports_move() const;
  VectorX derivative(double part, int order) const;

  const System& system_;
  Environment environment_, statics_;
  LoadRamp ramp_;
  Equilibrium path_equilibrium_, equilibrium_;
  StaticTangent tangent_;
  MassSaddle saddle_;
  std::vector<double> kinks_;
  double step_;
  bool supports_move_ = false;
  State path_;                                        ///< equilibrium of what acts at rest
  VectorX v_, a_, lambda_rate_;                       ///< along the path
  double largest_left_out_ = 0, largest_motion_ = 0;  ///< accelerations of nodes so far [m/s^2]
  std::vector<std::vector<Vector3>> deformations_;    ///< of the nodes by inertia, at the last points
  std::vector<double> times_;                         ///< of them
};

}  // namespace bielle::mechanism
