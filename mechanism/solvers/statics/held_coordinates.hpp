// Coordinates of joints that are kept during the search for equilibrium.
//
// The coordinates c(q) are constraints of that search only, with their own forces mu:
//     r + W^T mu = 0,   g = c(q) - c_0 = 0,   W = dc/dq.
// A step of Newton's method eliminates them with the tangent's factors, K Z = W^T:
//     delta = -K^-1 (r + W^T mu) - Z dmu,     (W Z) dmu = g - W K^-1 (r + W^T mu).
// W^T mu is taken as constant in W: the second derivatives of coordinates times mu are no part of the tangent. If
// nothing else holds such a motion, K holds it by StaticTangent; the effect of that small stiffness cancels.
#pragma once

#include <vector>

#include "mechanism/solvers/start/start_conditions.hpp"
#include "mechanism/solvers/statics/bordering.hpp"

namespace bielle::mechanism {

class HeldCoordinates final : public Bordering {
 public:
  /// @param held  conditions with the kept values; coordinates that constraints already determine (drives, locks) are
  ///              omitted
  HeldCoordinates(const System& system, const Environment& environment, const State& state,
                  const std::vector<CoordinateCondition>& held);

  bool any() const { return !held_.empty(); }
  void begin() override;  ///< sets the forces to zero
  void add_forces(const Environment& environment, const State& state, Eigen::Ref<VectorX> r) override;
  bool reached(const ResidualScale& /*scale*/) override {
    return gap_.size() == 0 || (gap_.array().abs() <= close_.array()).all();
  }
  void solve(const StaticTangent& tangent, const Eigen::Ref<const VectorX>& r, Eigen::Ref<VectorX> delta) override;
  void move(State& state, double part) override;
  void solve_along(const StaticTangent& tangent, const Eigen::Ref<const VectorX>& r,
                   Eigen::Ref<VectorX> delta) const override;

 private:
  VectorX eliminate(const StaticTangent& tangent, const VectorX& gap, Eigen::Ref<VectorX> delta) const;
  const System& system_;
  std::vector<CoordinateCondition> held_;
  MatrixX W_;  ///< (dofs, held), at the last residual
  VectorX gap_, close_, mu_, base_, change_;
};

}  // namespace bielle::mechanism
