// The LuGre law (friction_law.hpp): a bristle z [m] along each direction of the surface, as first-order unknowns,
//     zdot - u(z, v) = 0,   u = v - sigma_0 |v| z/mu,   R = N [sigma_0 z + sigma_1(s) u + sigma_2 v].
// In statics the bristles keep their values. Their elastic power, N sigma_0 z . u, counts as input: while N changes
// they have no potential. The dissipated power is N [sigma_0^2 |v| z^2/mu + sigma_1 u . v + sigma_2 v^2] >= 0.
#pragma once

#include "mechanism/joints/friction/joint_friction.hpp"

namespace bielle::mechanism {

class BristleFriction final : public JointFriction {
 public:
  using JointFriction::JointFriction;
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  /// The outputs include `bristles`: z.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;

 private:
  /// The rate u with its derivatives.
  struct Rate {
    Vector u;
    Matrix by_v, by_z;
  };
  Rate rate(const Vector& z, const Vector& v) const;
  Resistance resistance(const LocalState& state, const Vector& v) const override;
  double loss(const LocalState& state, const Vector& v, const Resistance& resistance) const override;
};

}  // namespace bielle::mechanism
