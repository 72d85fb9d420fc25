// A measure defined by a formula of other measures: `lag: "main.angle - motor.angle"`.
#pragma once

#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/time_dependent.hpp"

namespace bielle::mechanism {

class CombinedMeasure final : public Measure, public TimedMeasure {
 public:
  /// @param formula  formula of t and of the measures referred to
  CombinedMeasure(std::string name, References references, StateFormula formula, std::string units);
  std::string units() const override { return units_; }
  double value(const LocalState& state) const override;
  double calc(const LocalState& state, MeasureGradient& gradient) const override;
  bool reads_reactions() const override { return formula_.reads_reactions(); }
  bool holds_time() const override { return formula_.holds_time(); }
  void describe(const LocalState& state, Description& description) const override;
  void add_break_points(std::vector<double>& times) const override { formula_.add_break_points(0, times); }

 private:
  void declare_subjects(Declaration& declaration) const override { references_.declare(declaration); }
  References references_;
  StateFormula formula_;
  std::string units_;
};

}  // namespace bielle::mechanism
