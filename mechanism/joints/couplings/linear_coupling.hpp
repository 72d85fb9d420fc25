// Coordinates of joints in fixed ratios: the coupling e = 0 as a constraint (coordinate_coupling.hpp).
#pragma once

#include "mechanism/joints/couplings/coordinate_coupling.hpp"

namespace bielle::mechanism {

class LinearCoupling final : public CoordinateCoupling {
 public:
  using CoordinateCoupling::CoordinateCoupling;
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  double turning_rate(const LocalState& state) const override;

 private:
  double force(const LocalState& state) const override { return state.reaction()[0]; }
};

}  // namespace bielle::mechanism
