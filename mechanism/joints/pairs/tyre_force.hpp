// The force of a tyre with slip on a wheel (wheel.hpp) that the plane holds only in the normal direction.
//
// With the velocity of the contact (v_x, v_y) along t and l, and the hub's forward speed V_x along t,
//     sigma = (v_x, v_y)/V,   V = sqrt(V_x^2 + v_0^2)                     slip, v_0 a small speed for standing wheels
//     s = (C_x sigma_x, C_y sigma_y)                                      linear force
//     F = -s f(psi),  psi = |s|/(3 mu N),  f = 1 - psi + psi^2/3 for psi < 1, 1/(3 psi) beyond:
// the brush model with a parabolic distribution of pressure, whose force has two continuous derivatives and reaches mu
// N in full sliding. Without mu: F = -s at any slip. N is the normal force of the plane. Forces respond immediately (no
// relaxation length). Reference: H. B. Pacejka, Tire and Vehicle Dynamics, 3rd ed. (2012), section 3.2.
#pragma once

#include <optional>

#include "mechanism/joints/pairs/wheel.hpp"
#include "mechanism/model/references.hpp"

namespace bielle::mechanism {

struct TyreLaw {
  double longitudinal, lateral;    ///< C_x, C_y: slip stiffnesses [N], for a lateral slip tan(angle)
  std::optional<double> friction;  ///< mu
  double speed;                    ///< v_0 [m/s]
};

class TyreForce final : public Component {
 public:
  TyreForce(std::string name, const WheelJoint& wheel, const TyreLaw& law);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  /// Outputs `slip` (longitudinal, lateral) and `tyre_force` [N] along t and l, on the wheel.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;

 private:
  using Vector2 = Eigen::Vector2d;
  /// The force with its derivatives by v_x, v_y, V_x and N.
  template <int order>
  struct Force {
    WheelJoint::Slip<order> slip;
    Vector2 sigma, F;
    Eigen::Matrix2d by_v;
    Vector2 by_forward, by_N;
  };
  template <int order>
  Force<order> calc(const LocalState& of_wheel) const;
  const WheelJoint& wheel_;
  TyreLaw law_;
};

/// Returns the key `slip` of a wheel.
Key tyre_key();

/// Reads `slip: none | {longitudinal, lateral, friction, speed}` of a wheel's entry; no value: it rolls.
std::optional<TyreLaw> read_tyre_law(const YamlValue& entry);

}  // namespace bielle::mechanism
