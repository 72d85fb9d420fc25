// A friction clutch, a brake or a torque limiter on one coordinate of a joint, by Coulomb's law without regularisation.
//
// It holds the coordinate until the force or torque on it exceeds r C, and slips with C against the rate, with the
// capacity C >= 0, a formula of time and measures, and the ratio r >= 1 of the forces at rest and in motion. The
// capacity of plates that a force F presses together is C = F mu r_m n, with the mean radius r_m of n surfaces (uniform
// wear; J. E. Shigley, Mechanical Engineering Design, chapter 16). It is stick-slip friction (stick_slip_friction.hpp)
// whose velocity is the rate of the coordinate and whose normal force is C: steps end when it begins to slip and when
// it engages, and it yields to drives and locks of the same motion. With a capacity of zero it is open and does not
// engage. In statics it neither holds nor slips.
#pragma once

#include "mechanism/joints/friction/stick_slip_friction.hpp"
#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/references.hpp"
#include "mechanism/model/time_dependent.hpp"

namespace bielle::mechanism {

class Clutch final : public StickSlipFriction, public TimeDependent {
 public:
  /// @param ratio   r
  Clutch(const Joint& joint, std::size_t coordinate, double ratio);
  /// Reads C = factor times a formula of t and measures, after the model has been read.
  /// @param factor  factor, not negative
  void read(const YamlValue& formula, double factor, Model& model);

  void declare(Declaration& declaration) const override;
  /// Outputs along the joint's coordinates: `clutch_force`, `clutch_capacity`, `clutch_sticks` (1 if it holds).
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void add_break_points(std::vector<double>& times) const override { capacity_.add_break_points(0, times); }
  std::vector<Formula> time_formulas() const override;
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override;

 private:
  const JointCoordinate& coordinate() const { return joint().coordinates()[surface().parts.front().coordinate]; }
  double normal_force(const LocalState& state) const override;
  double calc_normal_force(const LocalState& state, MeasureGradient& gradient) const override;
  bool is_open(const LocalState& state) const override { return normal_force(state) == 0; }
  double checked(double capacity, const LocalState& state) const;
  References references_;
  StateFormula capacity_;
  double factor_ = 1;
};

}  // namespace bielle::mechanism
