// Coulomb's law itself on one coordinate (FrictionLaw::Model::stick_slip), in three branches:
//     sticks           v = 0 by a constraint, whose multiplier is the friction; until it reaches mu_s N
//     slips, dir = +-1 R = dir N mu(|v|) + N sigma_2 v; until v dir falls to zero
// Steps end where it begins to slip and where it comes to rest. Within a branch nothing has a kink, so that the scheme
// keeps its order. Where the constraint repeats another (a drive prescribes the motion), it is set aside, and slipping
// begins again with the next step that moves. In statics friction does not act: nothing moves there.
// What is at rest when a motion begins sticks, if friction can hold it. Impulses (a lock that closes) do not make what
// sticks slip.
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
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool leaves_branch(const LocalState& state) const override;
  bool is_on(const LocalState& state, int row) const override;
  /// Also `sticks`: 1, or 0 while it slips.
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;

 private:
  // Memory: direction of slip, 0 where it sticks, NaN before the motion has begun; whether it has slipped through an
  // accepted step; when it began to.
  static double direction(const LocalState& state);
  static bool has_slipped(const LocalState& state) { return state.memory()[1] != 0; }
  /// Whether a branch of slipping has led the wrong way: it is at rest.
  bool came_to_rest(const LocalState& state, double v) const;
  /// Velocities below it are rounding [m/s].
  double no_velocity(const LocalState& state) const;
  Resistance resistance(const LocalState& state, const Vector& v) const override;
  Vector held(const LocalState& state) const override;
};

}  // namespace bielle::mechanism
