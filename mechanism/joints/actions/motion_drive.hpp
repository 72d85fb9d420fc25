// Drives by motion: constraints on a joint's coordinate c with a multiplier.
//
//   angle or displacement (t):  constraint c(q) - f(t) = 0; its multiplier is the drive's torque or force on the
//                               coordinate, negated (the residual contains + B^T lambda). In a static analysis: c = s
//                               f(t), with the fraction s of the motion applied so far
//   rate or speed (t):          constraint cdot - f(t) = 0, non-holonomic; in statics the joint keeps its position
//
// A position drive begins at f(t_start): the assembly moves the joint to this value, and the joint counts turns from
// it. A released drive is a constraint that is switched off.
#pragma once

#include "mechanism/joints/actions/drive.hpp"
#include "mechanism/model/time_dependent.hpp"

namespace bielle::mechanism {

/// Common base of drives by motion: a function of time as a constraint with a multiplier.
class MotionDrive : public Drive, public TimeDependent {
 public:
  MotionDrive(std::string name, const Joint& joint, std::size_t coordinate, Expression f)
      : Drive(std::move(name), joint, coordinate), f_(std::move(f)) {}
  bool is_on(const LocalState& state, int /*row*/) const final { return !released(state); }
  std::vector<Formula> time_formulas() const final;
  void calc_time_formulas(const LocalState& state, std::span<double> values) const final;

 protected:
  const Expression& law() const { return f_; }
  virtual Part part() const = 0;  ///< role of the law
  double force(const LocalState& state) const final { return -state.reaction()[0]; }
  void add_kinks(std::vector<double>& times) const final;
  void declare_row(Declaration& declaration, const std::string& row, ConstraintKind kind) const;

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
  Part part() const override { return Part::position; }
  LawText law_text() const override { return {coordinate().name, law().text(), coordinate().units()}; }
  /// Returns the distance of the coordinate from the value that the law prescribes.
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
  Part part() const override { return Part::rate; }
  LawText law_text() const override {
    return {"rate of " + coordinate().name, law().text(), coordinate().rate_units()};
  }
};

}  // namespace bielle::mechanism
