// Valves operated by pressures: check, relief and counterbalance valves; and the pressure-compensated flow valve.
//
// A poppet opens over a range of pressures above its setting:
//     x = (p_a - s p_b + r p_x - p_set)/range,    A = A_full (10 x^3 - 15 x^4 + 6 x^5), 0 <= x <= 1,
// Pressures are relative to the ambient one, which acts in the spring chambers.
// check valve:           s = 1; r = 0; only from a to b
// relief valve:          s = 1 (or 0, if its spring chamber is vented), r = 0
// counterbalance valve:  a is the load, x the pilot, r its ratio; a check valve lets the fluid back from b to a
// With a time constant T the opening follows T ydot = y(x) - y. A motion begins with y = y(x), which statics find too.
// Events may lock the opening y (opening_lock.hpp); the check valve of a counterbalance valve still opens.
//
// A flow valve with compensator passes Q_set if D = p_a - p_b is larger than D_min; below it is an orifice. The reverse
// flow is through an orifice of the same area:
//     Q = Q_set sign(D) sqrt(D_e/D_min),   D_e = |D|/(1 + (|D|/D_min)^8)^(1/8) for D > 0, |D| for D < 0, both smooth at
//     0.
#pragma once

#include "mechanism/hydraulics/lines/line.hpp"
#include "mechanism/hydraulics/lines/opening_lock.hpp"
#include "mechanism/hydraulics/lines/orifice_law.hpp"
#include "mechanism/measures/time_formula.hpp"
#include "mechanism/model/lockable.hpp"

namespace bielle::mechanism {

class PoppetValve final : public Line, public Lockable {
 public:
  struct Setting {
    double pressure = 0;         ///< pressure p_set [Pa], at which it begins to open
    double range = 0;            ///< pressure range [Pa] in which it opens
    double back = 1;             ///< s
    double pilot_ratio = 0;      ///< r
    double area = 0;             ///< A_full [m^2]
    double time_constant = 0;    ///< T [s]; 0: none
    double check_pressure = -1;  ///< setting for reverse flow [Pa]; negative: none
  };
  /// @param pilot  nullptr: none
  PoppetValve(std::string type, std::string name, const PressureNode& from, const PressureNode& to,
              const PressureNode* pilot, const OrificeLaw& law, const Setting& setting);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_pattern(const Slots& slots, LocalPattern& pattern) const override;
  void calc_flow(const LocalState& state, std::size_t path, FlowDerivatives& flow) const override;
  void add_start_values(const LocalState& state, Eigen::Ref<VectorX> change) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool knows_memory(const LocalState& state) const override { return OpeningLock::knows(state.memory()); }
  int lock_command_place() const override { return OpeningLock::command; }
  int locked_value_place() const override { return OpeningLock::opening; }
  double present_value(const LocalState& state) const override;

 private:
  /// Returns the opening that corresponds to the pressures, with its derivatives.
  double wanted(const LocalState& state, MeasureGradient& gradient) const;
  double opening(const LocalState& state, MeasureGradient& gradient) const;
  std::vector<OutputField> own_fields() const override;
  void write_own(const LocalState& state, double* values) const override;
  std::string describe_law() const override;
  std::vector<std::string> own_measures() const override { return {"opening"}; }
  double calc_own_measure(const LocalState& state, const std::string& measure,
                          MeasureGradient& gradient) const override;
  bool follows() const { return setting_.time_constant > 0; }
  OrificeLaw law_;
  Setting setting_;
};

class FlowValve final : public Line, public TimeDependent {
 public:
  /// @param pressure  minimum pressure difference D_min [Pa]
  FlowValve(std::string name, const PressureNode& from, const PressureNode& to, double pressure);
  void read(const YamlValue& formula, Model& model);  ///< Q_set(t, measures) [m^3/s]
  void calc_flow(const LocalState& state, std::size_t path, FlowDerivatives& flow) const override;
  void add_break_points(std::vector<double>& times) const override { formula_.add_break_points(0, times); }
  std::vector<Formula> time_formulas() const override { return time_formulas_of(formula_, "flow", "m^3/s"); }
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override {
    calc_time_formula(formula_, state, values);
  }

 private:
  bool has_damping() const override { return formula_.reads_state(); }
  bool reads_reactions() const override { return formula_.reads_reactions(); }
  std::string describe_law() const override;
  double pressure_;
  StateFormula formula_;
};

}  // namespace bielle::mechanism
