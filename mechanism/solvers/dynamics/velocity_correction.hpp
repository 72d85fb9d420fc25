// Velocities across the constraints: the scheme of index 3 has its own offset of v_n.
//
// The scheme satisfies Phi(q) = 0, but not B v = 0. Its smooth solution has
//     B v_n = h^2 B c + O(h^3),   c = C_q j + [0; Omega x Omegadot]/12,   j = (A_n - A_{n-1})/h,
// A motion that starts without this offset has multipliers of first order (M. Arnold, O. Bruls, A. Cardona, Numer.
// Math. 129 (2015) 149). Without a correction, v and A across a constraint follow from Dq = 0 there:
//     beta z^2 + (1/2 + gamma - 2 beta) z + 1/2 - gamma + beta = 0,    z = -rho twice,
// for any step size: errors alternate and decay by rho per step. If the constraint rotates by epsilon per step, the
// double root splits into about rho (1 + epsilon): from a rotation of about 0.7 ln(1/rho) on, 0.154 with rho = 0.8,
// errors of constraint forces grow until they dominate the motion. With rho = 1 (Newmark) they grow at any step.
//
// If velocities across the constraints are given the offset after each step, v transfers no error from step to step,
// and the roots satisfy
//     beta z^2 + (1/2 - beta + C_q) z - C_q = 0,    |z| = sqrt(-C_q/beta) <= 0.58 for every rho.
// A rotating constraint is then harmless. Positions and accelerations of the step are not changed. The correction costs
// a factorisation of [M B^T; B 0]: it begins with the first step in which a constraint rotates by half the limit, and
// continues from then on. (It is not applied occasionally: if A has an alternating error, a single correction excites
// it.)
#pragma once

#include <optional>
#include <string>

#include "mechanism/solvers/constraints/kkt_matrix.hpp"
#include "mechanism/solvers/dynamics/scheme_step.hpp"

namespace bielle::mechanism {

/// Forms of the constraints: only those of positions; with velocities that are corrected after each step; also those of
/// velocities (stabilised_equations.hpp).
enum class ConstraintForm { position, corrected, stabilised };

class VelocityCorrection {
 public:
  VelocityCorrection(const System& system, const Environment& environment, ConstraintForm form);

  /// Adds factor w to v_n: the offset due to the rate j of accelerations,
  ///     [M B^T; B 0][w; mu] = [0; B c].
  /// In the stabilised form the velocities have no offset.
  void add_offset(SchemeStep& step, const VectorX& j, double factor);
  /// Computes how far constraints rotate in a converged trial, and corrects its velocities if this is far.
  void watch(SchemeStep& step);
  /// Returns a warning if joints rotate far in the last accepted step; otherwise empty.
  std::string caution(const SchemeStep& step);
  KktMatrix& saddle() { return saddle_; }
  void exchange(Archive& archive);

 private:
  VectorX target(const State& state, const VectorX& v, const VectorX& a, const VectorX& j, const Scheme& scheme) const;
  void keep_holonomic(const State& state, VectorX& rows) const;
  /// Upper bound of the rotation of constraint directions in a trial [rad], at negligible cost.
  double turn_of_constraints(const SchemeStep& step) const;
  /// Rotation of the velocity by constraints in the last accepted step [rad], in the norm of the kinetic energy: h
  /// |M^-1 B^T (B M^-1 B^T)^-1 Bdot v| / |v|. Positions lag by C_q times its square. It costs a factorisation.
  double turn_of_motion(const SchemeStep& step);
  void correct(SchemeStep& step);
  VectorX across_constraints(const State& state, const VectorX& rate);

  const System& system_;
  const Environment& environment_;
  ConstraintForm form_;
  KktMatrix saddle_;
  std::optional<KktMatrix> watching_saddle_;  ///< separate, so that the check does not change the motion
  double turn_ = 0;                           ///< rotation of constraints in the last accepted step [rad]
  bool turning_ = false;                      ///< rotation was large enough for the correction, now or before
};

}  // namespace bielle::mechanism
