// Velocities across the constraints: the part of v_n that the scheme of index 3 has for its own.
//
// The scheme keeps Phi(q) = 0 and not B v = 0. Its smooth solution has
//     B v_n = h^2 B c + O(h^3),   c = C_q j + [0; Omega x Omegadot]/12,   j = (A_n - A_{n-1})/h,
// and a motion that starts without that offset gets multipliers of first order (M. Arnold, O. Bruls, A. Cardona, Numer.
// Math. 129 (2015) 149). Left to itself, what v and A have across a constraint follows from Dq = 0 there:
//     beta z^2 + (1/2 + gamma - 2 beta) z + 1/2 - gamma + beta = 0,    z = -rho twice,
// however small the step: errors alternate and fade by rho per step. While the constraint turns by epsilon per step,
// the double root splits into about rho (1 + epsilon): from a turn of some 0.7 ln(1/rho) on, 0.154 with rho = 0.8,
// errors of constraint forces grow until nothing is left of the motion. With rho = 1 (Newmark) they grow at any step.
//
// Where velocities across the constraints are given the offset after each step, v no longer carries anything over from
// step to step, and there remains
//     beta z^2 + (1/2 - beta + C_q) z - C_q = 0,    |z| = sqrt(-C_q/beta) <= 0.58 for every rho.
// A constraint that turns then does no harm. Positions and accelerations of the step stay as they are. The correction
// costs a factorisation of [M B^T; B 0]: it begins with the first step in which a constraint turns by half the limit,
// and goes on from there. (Not now and then: where A holds an error that alternates, a single correction stirs it up.)
#pragma once

#include <optional>
#include <string>

#include "mechanism/solvers/constraints/mass_saddle.hpp"
#include "mechanism/solvers/dynamics/scheme_step.hpp"

namespace bielle::mechanism {

/// How constraints are kept: those of positions alone; with velocities that are corrected after each step; those of
/// velocities as well (stabilised_equations.hpp).
enum class ConstraintForm { position, corrected, stabilised };

class VelocityCorrection {
 public:
  VelocityCorrection(const System& system, const Environment& environment, ConstraintForm form);

  /// v_n += factor w: the offset that belongs to the rate j of accelerations,
  ///     [M B^T; B 0][w; mu] = [0; B c].
  /// Not in the stabilised form, whose velocities have none.
  void add_offset(SchemeStep& step, const VectorX& j, double factor);
  /// Looks how far constraints turn in a trial that has converged, and corrects its velocities once that is far.
  void watch(SchemeStep& step);
  /// What the user should know of the last accepted step, whose joints turn far: a sentence, or nothing.
  std::string caution(const SchemeStep& step);
  MassSaddle& saddle() { return saddle_; }
  void exchange(Archive& archive);

 private:
  VectorX target(const State& state, const VectorX& v, const VectorX& a, const VectorX& j, const Scheme& scheme) const;
  void keep_holonomic(const State& state, VectorX& rows) const;
  /// How far the directions of constraints may turn in a trial [rad]: a bound that costs nothing.
  double turn_of_constraints(const SchemeStep& step) const;
  /// How far constraints turn the velocity in the last accepted step [rad], in the norm of the kinetic energy:
  /// h |M^-1 B^T (B M^-1 B^T)^-1 Bdot v| / |v|. Positions fall behind by C_q times its square. Takes a factorisation.
  double turn_of_motion(const SchemeStep& step);
  void correct(SchemeStep& step);
  VectorX across_constraints(const State& state, const VectorX& rate);

  const System& system_;
  const Environment& environment_;
  ConstraintForm form_;
  MassSaddle saddle_;
  std::optional<MassSaddle> watching_saddle_;  ///< apart, so that a look changes no digit of the motion
  double turn_ = 0;                            ///< of constraints in the last accepted step [rad]
  bool turning_ = false;                       ///< fast enough for velocities to be corrected, now or before
};

}  // namespace bielle::mechanism
