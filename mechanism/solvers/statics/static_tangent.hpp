// The tangent at rest, where something may lie about that nothing holds: a link that can turn about its own axis
// between two spherical joints, a wheel on its axle.
//
// Along such a motion the stiffness K is zero. Where nothing loads it either there is equilibrium all the same, and it
// stays where it is: K is factorised with e D added, D the mean stiffness of translations, rotations and amplitudes on
// the diagonal and e = 1e-9. Residuals stay exact; Newton's method converges along all that is stiffer than e D as
// without. What is loaded along such a motion runs away and finds no equilibrium.
#pragma once

#include <string>

#include "mechanism/solvers/newton/linear_step.hpp"

namespace bielle::mechanism {

/// A linear response that is longer (turns [rad], or of the mechanism's size) may run away along what is loose: e is
/// 1e-9. Whether it does says StaticTangent::runs_loose: a mechanism drawn in a small space moves far along springs.
constexpr double runaway = 1e3;

class StaticTangent {
 public:
  explicit StaticTangent(const System& system) : system_(system), linear_(system) {}

  /// Decides from the tangent at a state, where an analysis sets off, whether something is loose.
  void look_for_loose(const State& state, const Environment& environment);
  /// dr/dq + inertia M, factorised. @param dq  see System::tangent; @throws ComputationError where it is singular, with
  /// what was loose at the start held
  void factor(const State& state, const Environment& environment, double inertia = 0, const VectorX* dq = nullptr);
  /// The same without inertia; @returns false where it is singular.
  bool try_factor(const State& state, const Environment& environment);
  void solve(const Eigen::Ref<const VectorX>& r, Eigen::Ref<VectorX> delta) const { linear_.solve(r, delta); }
  const LinearStep& linear() const { return linear_; }
  /// Whether a solution with the last factors lies along what nothing but e D holds. With P = (K + e D)^-1 e D, which
  /// leaves such motions as they are and makes e D/K of others, |P delta| > |delta|/2 in the norm of D: no length
  /// decides. @param delta  (dofs or more)
  bool runs_loose(const VectorX& delta) const;
  /// e D (dofs) where something was loose, otherwise none.
  const VectorX* held() const { return held_.size() > 0 ? &held_ : nullptr; }

 private:
  const System& system_;
  LinearStep linear_;
  VectorX held_;  ///< e D (dofs); empty: nothing is loose
};

/// The unknown that moves most in a motion (dofs or more): displacements count relative to the mechanism's size.
std::string moves_most(const System& system, const VectorX& motion, const State& state);

/// The unknown that moves most where neither stiffness nor a constraint resists; empty: everything is held.
std::string loose_unknown(const System& system, const Environment& environment, const State& state);

}  // namespace bielle::mechanism
