// A thin wheel on a plane.
//
// The plane is fixed on the first node: J_A is in it below the hub, z_A is its `normal`. The wheel is fixed on the
// second node: J_B is in the middle of the hub, z_B is along the wheel's `axis`. With c = z_A . z_B, s = sqrt(1 - c^2),
// which is computed as the length of the part of z_B normal to z_A (1 - c^2 loses its digits if the wheel is nearly
// flat), and the unit vector from the lowest point of the rim to the hub m = (z_A - c z_B)/s:
//     normal         r s - z_A . d = 0,   d from J_A to J_B: the rim touches the plane          (holonomic)
//     longitudinal   t . v_c = 0,   t = z_B x z_A / s: direction of a wheel that rotates about +z_B (non-holonomic)
//     lateral        l . v_c = 0,   l = z_A x t                                                 (non-holonomic)
// v_c is the velocity, relative to the plane, of the wheel's material at the contact, p_2 - r m. Multipliers: the
// normal force of the plane on the wheel [N], and the friction that prevents slip, negated. The contact is not
// released: an event is recorded when the normal force would have to pull ("lifts off").
// A wheel that lies flat (s = 0) has no lowest point: the run ends when s falls below a thousandth.
// References: J. I. Neimark, N. A. Fufaev, Dynamics of Nonholonomic Systems (1972); Geradin and Cardona (2001) ch. 7.
#pragma once

#include "mechanism/joints/measured_pair.hpp"

namespace bielle::mechanism {

class WheelJoint final : public MeasuredRows<WheelJoint> {
 public:
  /// @param rolls  whether the two rows that prevent slip are present
  WheelJoint(std::string name, JointFrames frames, double radius, bool rolls, const Model& model);
  void declare(Declaration& declaration) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void draw(Drawing& drawing) const override;

  /// Slip velocities as gradients w with their derivatives; the value is the velocity itself [m/s].
  template <int order>
  struct Slip {
    PairMeasureOf<order> longitudinal, lateral;
    PairMeasureOf<order> forward;  ///< velocity of the hub along t
  };
  /// Exists for orders 1 and 2.
  template <int order>
  Slip<order> calc_slip(const LocalState& state) const;

 private:
  friend MeasuredRows;
  template <int order>
  void rows(const LocalState& state, std::span<PairMeasureOf<order>> rows) const;
  double radius_;
};

const KeyTable& wheel_keys();
/// Reads `nodes: [of the plane, of the hub]`, `normal` of the plane, `position`: a point of it (default: below the
/// hub), or `at`: a point of the plane and the middle of the wheel in the axes of their nodes, `axis` of the wheel,
/// `radius`; inertial directions are initial ones.
void read_wheel(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
