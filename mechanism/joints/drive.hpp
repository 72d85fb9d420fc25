// Drives: what moves a joint's coordinate c.
//
//   angle or displacement (t):  constraint c(q) - f(t) = 0; its multiplier is the drive's torque or force on the
//                               coordinate, negated (the residual holds + B^T lambda). On the way of statics: c = s
//                               f(t) with the part s of the motion that is made
//   rate or speed (t):          constraint cdot - f(t) = 0, non-holonomic; in statics the joint stays where it is
//   torque or force (t):        generalised force f(t) along +c: the second node is pushed, the first pulled
//
// A position drive begins where f(t_start) says: the assembly moves the joint there, and the joint counts turns from
// there.
#pragma once

#include "mechanism/joints/joint.hpp"

namespace bielle::mechanism {

/// What all drives are: a law f(t) on one coordinate of a joint. Drives of one joint record their forces together.
class Drive : public Component {
 public:
  Drive(std::string name, const Joint& joint, std::size_t coordinate, Expression f);
  const JointCoordinate& coordinate() const { return joint_.coordinates()[coordinate_]; }
  std::vector<OutputField> output_fields() const final;
  void write_output(const LocalState& state, double* values) const final;
  void add_break_points(std::vector<double>& times) const final;

 protected:
  PairMeasure measure(const LocalState& state) const;           ///< the joint's coordinate
  void declare_nodes(Declaration& declaration) const;       ///< those of the joint, with a stiffness
  std::string force_units() const;                          ///< of the driven coordinate
  virtual double force(const LocalState& state) const = 0;  ///< along the coordinate [N] or [N m]

  const Expression& law() const { return f_; }

 private:
  const Joint& joint_;
  std::size_t coordinate_;
  Expression f_;
};

/// Prescribes a coordinate: c = f(t).
class PositionDrive final : public Drive {
 public:
  using Drive::Drive;
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;

 private:
  PairMeasure distance(const LocalState& state) const;  ///< from where the law wants the coordinate
  double force(const LocalState& state) const override;
};

/// Prescribes a coordinate's rate: cdot = f(t).
class RateDrive final : public Drive {
 public:
  using Drive::Drive;
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;

 private:
  double force(const LocalState& state) const override;
};

/// Acts along a coordinate with a given force or torque.
class ForceDrive final : public Drive {
 public:
  using Drive::Drive;
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;

 private:
  double force(const LocalState& state) const override;
};

/// Reads an entry of `drives`: `{joint: main, angle: "speed*t"}`.
void read_drive(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
