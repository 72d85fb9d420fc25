// Coordinates of joints that stay where they are while the rest comes into equilibrium.
//
// The coordinates c(q) are constraints of that search alone, with forces mu of their own:
//     r + W^T mu = 0,   g = c(q) - c_0 = 0,   W = dc/dq.
// A step of Newton's method eliminates them with the tangent's factors, K Z = W^T:
//     delta = -K^-1 (r + W^T mu) - Z dmu,     (W Z) dmu = g - W K^-1 (r + W^T mu).
// W^T mu is taken as constant in W: the second derivatives of coordinates times mu are no part of the tangent. If
// nothing else holds such a motion, K holds it by StaticTangent, and the rest of that small stiffness does not matter.
#pragma once

#include <vector>

#include "mechanism/solvers/start/start_conditions.hpp"
#include "mechanism/solvers/statics/static_tangent.hpp"

namespace bielle::mechanism {

class HeldCoordinates {
 public:
  /// @param held  values say where; those that constraints hold anyway (drives, locks) are left to them
  HeldCoordinates(const System& system, const Environment& environment, const State& state,
                  const std::vector<CoordinateCondition>& held);

  bool any() const { return !held_.empty(); }
  /// No forces; a search begins.
  void begin();
  /// Adds the forces to a residual (size), and notes gaps and rows at the state.
  void add_forces(const Environment& environment, const State& state, Eigen::Ref<VectorX> r);
  /// Whether they are where they stay, to rounding.
  bool reached() const { return gap_.size() == 0 || (gap_.array().abs() <= close_.array()).all(); }
  /// delta of the tangent's factors for a residual r with the forces in it; the change of the forces is kept for
  /// `move`.
  void solve(const StaticTangent& tangent, const Eigen::Ref<const VectorX>& r, Eigen::Ref<VectorX> delta);
  /// A step's direction is taken: its parts begin from here.
  void set_base() { base_ = mu_; }
  void move(double part);
  /// Takes the gaps for zero in the next solution: a motion along which nothing is held.
  void solve_along(const StaticTangent& tangent, const Eigen::Ref<const VectorX>& r, Eigen::Ref<VectorX> delta) const;

 private:
  VectorX eliminate(const StaticTangent& tangent, const VectorX& gap, Eigen::Ref<VectorX> delta) const;
  const System& system_;
  std::vector<CoordinateCondition> held_;
  MatrixX W_;  ///< (dofs, held), of the last residual
  VectorX gap_, close_, mu_, base_, change_;
};

}  // namespace bielle::mechanism
