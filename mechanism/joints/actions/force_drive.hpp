// A drive by a force or torque: a formula of time and measures, optionally within limits.
#pragma once

#include "mechanism/joints/actions/actuator_drive.hpp"
#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/time_dependent.hpp"

namespace bielle::mechanism {

class ForceDrive final : public ActuatorDrive, public TimeDependent {
 public:
  using ActuatorDrive::ActuatorDrive;
  /// Reads its law, after the model has been read. @param law  formula of t and measures
  void read(const YamlValue& law, Model& model);
  void declare(Declaration& declaration) const override;
  std::vector<Formula> time_formulas() const override;
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override;

 private:
  double effort(const LocalState& state) const override;
  void calc_effort(const LocalState& state, Effort& effort) const override;
  bool reads_state() const override { return law_.reads_state(); }
  void add_kinks(std::vector<double>& times) const override { law_.add_break_points(0, times); }
  LawText law_text() const override;
  StateFormula law_;
};

}  // namespace bielle::mechanism
