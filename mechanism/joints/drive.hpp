// Drives: what moves a joint's coordinate c.
//
//   angle or displacement (t):  constraint c(q) - f(t) = 0; its multiplier is the drive's torque or force on the
//                               coordinate, negated (the residual holds + B^T lambda). In statics, with the load
//                               factor s: c = (1 - s) c_0 + s f(t), c_0 from where the analysis before ended
//   rate or speed (t):          constraint cdot - f(t) = 0, non-holonomic; in statics the joint stays where it is
//   torque or force (t):        generalised force f(t) along +c: the second node is pushed, the first pulled
//
// A position drive begins where f(t_start) says: the assembly moves the joint there, and the joint counts turns from
// there.
#pragma once

#include "mechanism/joints/joint.hpp"

namespace bielle::mechanism {

/// Prescribes a coordinate: c = f(t).
class PositionDrive final : public Component {
 public:
  PositionDrive(std::string name, const Joint& joint, std::size_t coordinate, Expression f);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void add_break_points(std::vector<double>& times) const override;

 private:
  Measure measure(const LocalState& state) const;
  const Joint& joint_;
  std::size_t coordinate_;
  Expression f_;
};

/// Prescribes a coordinate's rate: cdot = f(t).
class RateDrive final : public Component {
 public:
  RateDrive(std::string name, const Joint& joint, std::size_t coordinate, Expression f);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void add_break_points(std::vector<double>& times) const override;

 private:
  Measure measure(const LocalState& state) const;
  const Joint& joint_;
  std::size_t coordinate_;
  Expression f_;
};

/// Acts along a coordinate with a given force or torque.
class ForceDrive final : public Component {
 public:
  ForceDrive(std::string name, const Joint& joint, std::size_t coordinate, Expression f);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void add_break_points(std::vector<double>& times) const override;

 private:
  Measure measure(const LocalState& state) const;
  double force(const LocalState& state) const;
  const Joint& joint_;
  std::size_t coordinate_;
  Expression f_;
};

/// Reads an entry of `drives`: `{joint: main, angle: "speed*t"}`.
void read_drive(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
