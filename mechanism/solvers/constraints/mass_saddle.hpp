// The matrix [M B^T; B 0] of consistent starts, impulses and velocity corrections, with its factors kept from use to
// use.
#pragma once

#include "mechanism/solvers/newton/linear_step.hpp"

namespace bielle::mechanism {

class MassSaddle {
 public:
  explicit MassSaddle(const System& system) : system_(system), linear_(system) {}

  /// Factorises at a state, with the rows and columns of first-order rates and algebraic unknowns. Where dofs without
  /// mass make it singular, they get a floor of 1e-12 of their kind's mean.
  /// @throws ComputationError naming an unknown that has no mass and that nothing holds
  void factor(const Environment& environment, const State& state);
  /// The same with the derivatives of forces by multipliers, [M B^T + df/dlambda; B 0]. @returns false when singular
  bool factor_with_reactions(const Environment& environment, const State& state);
  /// What was added to the diagonal of dofs without mass (dofs); zero elsewhere.
  const VectorX& floor() const { return floor_; }
  /// step = -(matrix)^-1 r. @param r,step (size)
  void solve(const Eigen::Ref<const VectorX>& r, Eigen::Ref<VectorX> step) const { linear_.solve(r, step); }
  double scale() const { return linear_.scale(); }  ///< of the masses
  /// Sign of the last matrix's determinant.
  int determinant_sign() const { return linear_.determinant_sign(); }

  /// While the factors are those of the present positions and constraints, or near enough for refinement.
  bool serves() const { return serves_; }
  void serve_no_more() { serves_ = false; }
  void choose_pivots_anew() {
    linear_.choose_pivots_anew();
    serves_ = false;
  }

 private:
  const System& system_;
  LinearStep linear_;
  VectorX floor_;
  bool serves_ = false;
};

/// A fraction of the mean diagonal of each kind of dof of the last tangent. A kind without any takes it from the other
/// by the model's length: inertia = mass * length^2.
VectorX small_diagonal(const System& system, const LinearStep& linear, const State& state, double fraction);

[[noreturn]] void throw_massless(const std::string& what, const char* lack);

}  // namespace bielle::mechanism
