// The tangent at rest, with possibly unsupported parts: a link that can rotate about its own axis between two spherical
// joints, a wheel on its axle.
//
// Along such a motion the stiffness K is zero. If it is not loaded either, there is an equilibrium, and the motion is
// held: K is factorised with e D added, where D is the mean stiffness of translations, rotations and amplitudes on the
// diagonal and e = 1e-9. Residuals stay exact; for motions that are stiffer than e D, Newton's method converges as
// without it. Parts that are loaded along such a motion diverge and find no equilibrium.
#pragma once

#include <string>

#include "mechanism/solvers/newton/newton_matrix.hpp"

namespace bielle::mechanism {

/// A linear response longer than this (rotations [rad], or relative to the mechanism's size) may diverge along an
/// indifferent motion: e is 1e-9. StaticTangent::runs_loose decides whether it does: a mechanism with small initial
/// size moves far along springs.
constexpr double runaway = 1e3;

class StaticTangent {
 public:
  explicit StaticTangent(const System& system) : system_(system), linear_(system) {}

  /// Decides from the tangent at a state, at the start of an analysis, whether there are indifferent motions.
  void look_for_loose(const State& state, const Environment& environment);
  /// Factorises dr/dq + inertia M. @param dq  see System::tangent; @throws ComputationError if it is singular, with the
  /// initially indifferent motions held
  void factor(const State& state, const Environment& environment, double inertia = 0, const VectorX* dq = nullptr);
  /// Factorises without inertia; @returns false if it is singular.
  bool try_factor(const State& state, const Environment& environment);
  void solve(const Eigen::Ref<const VectorX>& r, Eigen::Ref<VectorX> delta) const { linear_.solve(r, delta); }
  const NewtonMatrix& linear() const { return linear_; }
  /// Returns whether a solution with the last factors is along motions that only e D resists. With P = (K + e D)^-1 e
  /// D, which preserves such motions and reduces others by e D/K, the criterion is |P delta| > |delta|/2 in the norm of
  /// D: no length is involved. @param delta  (dofs or more)
  bool runs_loose(const VectorX& delta) const;
  /// e D (dofs) if there was an indifferent motion, otherwise null.
  const VectorX* held() const { return held_.size() > 0 ? &held_ : nullptr; }

 private:
  const System& system_;
  NewtonMatrix linear_;
  VectorX held_;  ///< e D (dofs); empty: no indifferent motion
};

/// Returns the unknown with the largest part in a motion (dofs or more): displacements are relative to the mechanism's
/// size.
std::string moves_most(const System& system, const VectorX& motion, const State& state);

/// Returns the unknown with the largest motion without stiffness or constraint; empty: everything is held.
std::string loose_unknown(const System& system, const Environment& environment, const State& state);

}  // namespace bielle::mechanism
