// Coulomb's law without regularisation on one coordinate (FrictionLaw::Model::stick_slip), with two branches:
//     sticks           the coordinate is held by a constraint, whose multiplier is the friction, up to mu_s N
//     slips, dir = +-1 R = dir N mu(|v|) + N sigma_2 v, until v dir decreases to zero
// Steps end when it begins to slip and when it comes to rest. Within a branch there are no kinks, so that the scheme
// keeps its order. If several joints are overloaded at once, the most overloaded is released first. The constraint
// yields to others: if a drive or a lock, or the friction of an earlier joint, holds the same motion, it is set aside
// and its friction is zero. If it is driven through a reversal, the joint continues to slip in the opposite direction.
// It also slips in the opposite direction at a dead centre from which other parts move it on
// (solvers/start/refused_holds.hpp). Before a motion begins, and in statics, it neither sticks nor slips. At the start
// of a motion, joints at rest stick if friction can hold them. Impulses (a closing lock) do not release sticking
// joints.
#pragma once

#include "mechanism/joints/friction/joint_friction.hpp"

namespace bielle::mechanism {

class StickSlipFriction : public JointFriction {
 public:
  StickSlipFriction(const Joint& joint, FrictionSurface surface, const FrictionLaw& law)
      : JointFriction(joint, std::move(surface), law) {}
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void begin_motion(const LocalState& state, bool known, Eigen::Ref<VectorX> memory) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool leaves_branch(const LocalState& state) const override;
  bool is_on(const LocalState& state, int row) const override;
  /// The outputs include `sticks`: 1 along the coordinates of a sticking surface, otherwise 0.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;

 protected:
  /// Clutches derive from this class, because they hold and slip by the same law.
  using JointFriction::JointFriction;
  /// Tells whether it sticks by its constraint.
  static bool sticks(const LocalState& state);
  /// Tells whether nothing presses the surfaces together. The joint then slips without force, in either direction.
  virtual bool is_open(const LocalState& /*state*/) const { return false; }
  /// Returns R [N], resisting motion along v. @param lambda  the component's multiplier
  double resisting_force(const LocalState& state, double lambda) const;

 private:
  /// Returns the direction of slip: +1 or -1, or 0 if it sticks or neither sticks nor slips.
  static double direction(const LocalState& state);
  /// Tells whether it sticks by its own constraint, which is not set aside.
  bool holds(const LocalState& state) const { return is_on(state, 0) && !state.idle(0); }
  void stick_here(const LocalState& state, Eigen::Ref<VectorX> memory) const;
  /// @param moving  whether it has a velocity already; otherwise it is at rest and about to move
  static void slip_along(double direction, bool moving, const LocalState& state, Eigen::Ref<VectorX> memory);
  /// Returns the distance from the position at which it stuck [m].
  double distance(const LocalState& state) const;
  /// Returns the sliding acceleration [m/s^2].
  double acceleration(const LocalState& state) const;
  double longest_arm() const;
  // Rounding limits of velocities and of accelerations.
  double no_velocity(const LocalState& state) const;
  double no_acceleration(const LocalState& state) const;
  Resistance resistance(const LocalState& state, const Vector& v) const override;
  Vector held(const LocalState::Segment& lambda) const override;
};

}  // namespace bielle::mechanism
