// Coulomb's law itself on one coordinate (FrictionLaw::Model::stick_slip), in three branches:
//     sticks           the coordinate stays by a constraint, whose multiplier is the friction; until it reaches mu_s N
//     slips, dir = +-1 R = dir N mu(|v|) + N sigma_2 v; until v dir falls to zero
// Steps end where it begins to slip and where it comes to rest. Within a branch nothing has a kink, so that the scheme
// keeps its order. Where several joints are overloaded at once, the most overloaded lets go first.
// The constraint yields to others: where a drive or a lock, or the friction of a joint that comes before, holds the
// same motion, it is set aside and its friction is zero. Driven through a reversal the joint slips on, the other way.
// At a dead centre, where others move it on, it slips on the other way as well (solvers/start/refused_holds.hpp).
// Before a motion begins, and in statics, it neither sticks nor slips. A motion begins with what is at rest sticking,
// if friction can hold it. Impulses (a lock that closes) do not make what sticks slip.
#pragma once

#include "mechanism/joints/friction/joint_friction.hpp"

namespace bielle::mechanism {

class StickSlipFriction final : public JointFriction {
 public:
  using JointFriction::JointFriction;
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  void add_reaction_norm(const LocalState& state, double arm, Eigen::Ref<MatrixX> H) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void calc_crossings(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void begin_motion(const LocalState& state, bool known, Eigen::Ref<VectorX> memory) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool leaves_branch(const LocalState& state) const override;
  bool is_on(const LocalState& state, int row) const override;
  /// Also `sticks`: 1 along the coordinates of a surface that does, else 0.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;

 private:
  /// Direction of slip; 0 where it sticks, or neither.
  static double direction(const LocalState& state);
  /// Whether it sticks by its own constraint, which is not set aside.
  bool holds(const LocalState& state) const { return is_on(state, 0) && !state.idle(0); }
  void stick_here(const LocalState& state, Eigen::Ref<VectorX> memory) const;
  /// @param moving  whether it has a velocity; otherwise it is about to
  static void slip_along(double direction, bool moving, const LocalState& state, Eigen::Ref<VectorX> memory);
  /// How far it is from where it stuck [m].
  double distance(const LocalState& state) const;
  /// Sliding acceleration [m/s^2].
  double acceleration(const LocalState& state) const;
  double longest_arm() const;
  // What is rounding of velocities and of accelerations.
  double no_velocity(const LocalState& state) const;
  double no_acceleration(const LocalState& state) const;
  Resistance resistance(const LocalState& state, const Vector& v) const override;
  Vector held(const LocalState::Segment& lambda) const override;
};

}  // namespace bielle::mechanism
