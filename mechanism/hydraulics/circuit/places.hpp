// Places of a circuit without fluid of their own: junctions, and places of given pressure.
#pragma once

#include "mechanism/hydraulics/circuit/pressure_node.hpp"
#include "mechanism/measures/time_formula.hpp"
#include "mechanism/model/flow_balance.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/references.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Junction of lines without storage: the sum of flows is zero. Its pressure is an algebraic unknown. If all lines are
/// closed it keeps its pressure p_0 of the last step: the sum of flows is actually g (p - p_0), with a negligible g
/// (1e-22 m^3/(s Pa): a drop in a year under 100 bar).
class Junction final : public PressureNode, public FlowBalance {
 public:
  Junction(std::string name, const Fluid& fluid, double pressure)
      : PressureNode("junction", std::move(name), fluid, {0, 0, -1}), start_(pressure) {}
  void declare(Declaration& declaration) const override;
  Range balance_range() const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void add_pattern(const Slots& slots, LocalPattern& pattern) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override { values[0] = pressure(state); }
  void describe(const LocalState& state, Description& description) const override;

 private:
  static constexpr double holding = 1e-22;  ///< g [m^3/(s Pa)]
  double start_;
};

/// Place with a given pressure p = p_s(t, measures), which does not depend on the flow: a tank, or a supply with a
/// pressure-controlled pump. Its second unknown is the flow into it [m^3/s].
class PressureSource final : public PressureNode, public TimeDependent {
 public:
  PressureSource(std::string name, const Fluid& fluid)
      : PressureNode("pressure_source", std::move(name), fluid, {0, 1, -1}) {}
  /// Reads the formula of p, after the model has been read.
  void read(const YamlValue& formula, Model& model);
  void keep(double pressure) { formula_ = StateFormula(pressure); }  ///< sets a constant pressure instead
  bool is_given() const override { return true; }
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void add_break_points(std::vector<double>& times) const override { formula_.add_break_points(0, times); }
  std::vector<Formula> time_formulas() const override { return time_formulas_of(formula_, "pressure", "Pa"); }
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override {
    calc_time_formula(formula_, state, values);
  }
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;

 private:
  double given(const LocalState& state) const;
  double power(const LocalState& state) const;
  StateFormula formula_;
  References references_;
};

}  // namespace bielle::mechanism
