// The matrix [M B^T; B 0] of consistent starts, impulses and velocity corrections; its factors are reused.
#pragma once

#include "mechanism/solvers/newton/newton_matrix.hpp"

namespace bielle::mechanism {

class KktMatrix {
 public:
  explicit KktMatrix(const System& system) : system_(system), linear_(system) {}

  /// Factorises the matrix at a state, with the rows and columns of first-order rates and algebraic unknowns. If dofs
  /// without mass make it singular, they get a mass of 1e-12 of their kind's mean.
  /// @throws ComputationError naming an unknown that has neither mass nor a constraint
  void factor(const Environment& environment, const State& state);
  /// Factorises the matrix with the derivatives of forces by multipliers, [M B^T + df/dlambda; B 0]. @returns false if
  /// it is singular
  bool factor_with_reactions(const Environment& environment, const State& state);
  /// Masses that were added to the diagonal of dofs without mass (dofs); zero elsewhere.
  const VectorX& floor() const { return floor_; }
  /// step = -(matrix)^-1 r. @param r,step (size)
  void solve(const Eigen::Ref<const VectorX>& r, Eigen::Ref<VectorX> step) const { linear_.solve(r, step); }
  double scale() const { return linear_.scale(); }  ///< scale of the masses
  /// Sign of the last matrix's determinant.
  int determinant_sign() const { return linear_.determinant_sign(); }

  /// Returns whether the factors are those of the present positions and constraints, or near enough for iterative
  /// refinement.
  bool serves() const { return serves_; }
  void serve_no_more() { serves_ = false; }
  void choose_pivots_anew() {
    linear_.choose_pivots_anew();
    serves_ = false;
  }

 private:
  const System& system_;
  NewtonMatrix linear_;
  VectorX floor_;
  bool serves_ = false;
};

/// Returns a fraction of the mean diagonal of the last tangent for each kind of dof. A kind without diagonal entries
/// takes it from the other kind by the model's length: inertia = mass * length^2.
VectorX small_diagonal(const System& system, const NewtonMatrix& linear, const State& state, double fraction);

[[noreturn]] void throw_massless(const std::string& what, const char* lack);

}  // namespace bielle::mechanism
