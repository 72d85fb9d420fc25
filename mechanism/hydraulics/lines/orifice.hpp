// Lines without controlling parts: orifices of given area, narrow gaps, and flow sources.
#pragma once

#include "mechanism/hydraulics/lines/line.hpp"
#include "mechanism/hydraulics/lines/orifice_law.hpp"
#include "mechanism/measures/time_formula.hpp"

namespace bielle::mechanism {

/// An orifice of the area A(t, measures) >= 0 [m^2].
class Orifice final : public Line, public TimeDependent {
 public:
  Orifice(std::string name, const PressureNode& from, const PressureNode& to, const OrificeLaw& law, double area);
  /// Reads a formula that replaces the area, after the model has been read.
  void read_area_formula(const YamlValue& formula, Model& model);
  void calc_flow(const LocalState& state, std::size_t path, FlowDerivatives& flow) const override;
  void add_break_points(std::vector<double>& times) const override { area_.add_break_points(0, times); }
  std::vector<Formula> time_formulas() const override { return time_formulas_of(area_, "area", "m^2"); }
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override {
    calc_time_formula(area_, state, values);
  }

 private:
  bool has_damping() const override { return area_.reads_state(); }
  bool reads_reactions() const override { return area_.reads_reactions(); }
  std::string describe_law() const override;
  OrificeLaw law_;
  StateFormula area_;
};

/// A narrow gap or a laminar resistance: Q = G (p_a - p_b).
class Leakage final : public Line {
 public:
  /// @param to           nullptr: outside, at the ambient pressure
  /// @param conductance  G [m^3/(s Pa)]
  Leakage(std::string name, const PressureNode& from, const PressureNode* to, double conductance);
  void calc_flow(const LocalState& state, std::size_t path, FlowDerivatives& flow) const override;

 private:
  std::string describe_law() const override;
  double conductance_;
};

/// A pump with a given flow Q(t, measures) [m^3/s], from a place or from outside. Its power counts as input.
class FlowSource final : public Line, public TimeDependent {
 public:
  /// @param from  nullptr: from outside, at the ambient pressure
  FlowSource(std::string name, const PressureNode* from, const PressureNode& to);
  void read(const YamlValue& formula, Model& model);
  void calc_flow(const LocalState& state, std::size_t path, FlowDerivatives& flow) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void add_break_points(std::vector<double>& times) const override { formula_.add_break_points(0, times); }
  std::vector<Formula> time_formulas() const override { return time_formulas_of(formula_, "flow", "m^3/s"); }
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override {
    calc_time_formula(formula_, state, values);
  }

 private:
  bool has_damping() const override { return formula_.reads_state(); }
  bool reads_reactions() const override { return formula_.reads_reactions(); }
  std::string describe_law() const override;
  StateFormula formula_;
};

}  // namespace bielle::mechanism
