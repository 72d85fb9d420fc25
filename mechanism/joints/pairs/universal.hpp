// Universal (Hooke's, Cardan) and constant-velocity joints: two shafts whose axes intersect at a point, with a variable
// angle between them.
//
// Universal: a cross, one axis of which, z of the joint's frame (`axis`), is fixed on the first node, and the other
// axis, x (`second_axis`), on the second. Rows: the point (x y z), and z_A . x_B = 0. Its multiplier is the torque
// about the cross's normal [N m]. Coordinates: `angle_1`, of the cross about z_A relative to the first node; `angle_2`,
// of the second node about x_B relative to the cross:
//     angle_1 = atan2(y_A . x_B, x_A . x_B),   angle_2 = atan2(z_A . y_B, z_A . z_B).
// Shafts that are initially along the cross's normal receive cos(angle_1) and cos(angle_2) times its torque. If one of
// these is zero the joint is singular: no finite torque holds that shaft, which can rotate alone. Runs record this as
// an event.
//
// Constant velocity: z_A and z_B are the axes of the two shafts, from the first to the second (`axis` if the joint is
// initially straight, `axes` if it is initially bent). Rows: the point, and
//     (y_A . x_B - x_A . y_B)/2 = 0.
// The left side is sin(theta) n_z of the rotation by theta about n that takes J_A to J_B: the row keeps n normal to
// z_A, and then n is normal to z_B as well (the rotation leaves n where it is). So the shafts bend about an axis that
// is normal to both, they are mirrored by the plane through the joint that bisects their bend (the homokinetic plane),
// and equal rates follow. Let the two shafts rotate by phi_1 and phi_2 in bearings that keep the bend theta, with n =
// (cos(beta), sin(beta), 0) in the axes of the first. The bend's axis is fixed in space. Seen from the first shaft its
// angle is beta = beta_0 - phi_1; from the second, whose axes give it the same components (C n = n, C from J_B to J_A),
// beta = beta_0 - phi_2. Therefore phi_1 = phi_2 at every bend below half a turn. At 180 degrees the two axes coincide
// and n is no longer determined. Coordinates: `bend_x` and `bend_y`, the rotation vector theta n of J_B relative to
// J_A; its z component is zero.
#pragma once

#include "mechanism/joints/measured_pair.hpp"
#include "mechanism/model/assembly_branch.hpp"

namespace bielle::mechanism {

class UniversalJoint final : public MeasuredRows<UniversalJoint> {
 public:
  UniversalJoint(std::string name, JointFrames frames, const Model& model);
  void declare(Declaration& declaration) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  /// The bearings of the two axes of its cross.
  std::vector<SlidingSurface> sliding_surfaces() const override { return {{{0}}, {{1}}}; }

 private:
  friend MeasuredRows;
  template <int order>
  void rows(const LocalState& state, std::span<PairMeasureOf<order>> rows) const;
  PairMeasure calc_own_coordinate(std::size_t index, const LocalState& state) const override;
  PairSlope calc_own_slope(std::size_t index, const LocalState& state) const override;
  template <int order>
  PairMeasureOf<order> own_angle(std::size_t index, const LocalState& state) const;
};

class ConstantVelocityJoint final : public MeasuredRows<ConstantVelocityJoint>, public AssemblyBranch {
 public:
  ConstantVelocityJoint(std::string name, JointFrames frames, const Model& model);
  std::string wrong_branch(const LocalState& state) const override;

 private:
  friend MeasuredRows;
  template <int order>
  void rows(const LocalState& state, std::span<PairMeasureOf<order>> rows) const;
};

const KeyTable& universal_keys();
void read_universal(const std::string& name, const YamlValue& entry, Model& model);
const KeyTable& constant_velocity_keys();
void read_constant_velocity(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
