// Drives: what moves a joint's coordinate c.
//
//   angle or displacement (t):  constraint c(q) - f(t) = 0; its multiplier is the drive's torque or force on the
//                               coordinate, negated (the residual holds + B^T lambda). In a static analysis: c = s
//                               f(t), s the fraction of the motion applied so far
//   rate or speed (t):          constraint cdot - f(t) = 0, non-holonomic; in statics the joint stays where it is
//   torque or force:            generalised force f(t, measures) along +c: the second node is pushed, the first pulled
//
// A position drive begins where f(t_start) says: the assembly moves the joint there, and the joint counts turns from
// there.
#pragma once

#include "mechanism/joints/actions/coordinate_action.hpp"
#include "mechanism/measures/state_formula.hpp"
#include "reduce/common/yaml_file.hpp"

namespace bielle::mechanism {

/// What all drives are: a law on one coordinate of a joint. Drives of one joint record their forces together.
class Drive : public CoordinateAction {
 public:
  Drive(std::string name, const Joint& joint, std::size_t coordinate)
      : CoordinateAction("drive", std::move(name), joint, coordinate) {}
  std::vector<OutputField> output_fields() const final;
  void write_output(const LocalState& state, double* values) const final { write_force(force(state), values); }
  void describe(const LocalState& state, Description& description) const final;

 protected:
  virtual double force(const LocalState& state) const = 0;  ///< along the coordinate [N] or [N m]
  /// What is driven, the law as the user wrote it, and its units: {"rate of angle", "speed*t", "rad/s"}.
  struct LawText {
    std::string driven, law, units;
  };
  virtual LawText law_text() const = 0;
};

/// What drives by motion are: a function of time, kept by a multiplier.
class MotionDrive : public Drive {
 public:
  MotionDrive(std::string name, const Joint& joint, std::size_t coordinate, Expression f)
      : Drive(std::move(name), joint, coordinate), f_(std::move(f)) {}
  void add_break_points(std::vector<double>& times) const final;

 protected:
  const Expression& law() const { return f_; }
  double force(const LocalState& state) const final { return -state.multiplier()[0]; }

 private:
  Expression f_;
};

/// Prescribes a coordinate: c = f(t).
class PositionDrive final : public MotionDrive {
 public:
  using MotionDrive::MotionDrive;
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;

 private:
  LawText law_text() const override { return {coordinate().name, law().text(), coordinate().units()}; }
  /// Of the coordinate from the value that the law prescribes.
  double distance(const LocalState& state, double principal) const;
};

/// Prescribes a coordinate's rate: cdot = f(t).
class RateDrive final : public MotionDrive {
 public:
  using MotionDrive::MotionDrive;
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;

 private:
  LawText law_text() const override {
    return {"rate of " + coordinate().name, law().text(), coordinate().rate_units()};
  }
};

/// Acts along a coordinate with a force or torque, a formula of time and measures.
class ForceDrive final : public Drive {
 public:
  using Drive::Drive;
  /// Takes its law, once the model is read. @param law  of t and measures
  void read(const YamlValue& law, Model& model);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void add_break_points(std::vector<double>& times) const override { law_.add_break_points(0, times); }

 private:
  double force(const LocalState& state) const override;
  LawText law_text() const override;
  StateFormula law_;
};

/// Reads an entry of `drives`: `{joint: main, angle: "speed*t"}`.
void read_drive(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
