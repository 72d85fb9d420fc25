// Rotary machine: a pump driven by a shaft, or a motor that drives it. Its shaft is a coordinate of a joint.
//
//     Q = x D rate + G (p_a - p_b)         from port a to port b [m^3/s]
//     T = x D (e_a - e_b) - d rate         on the coordinate [N m]
// The symbols are the displacement D [m^3/rad], the setting x(t, measures) (1: full; a variable machine has -1 to 1),
// the leakage G and the drag d. With the heads e of the fluid instead of pressures (fluid.hpp; they are larger by p/(2
// B) if volumes are conserved, smaller by the same amount if mass is) the machine itself has no losses. As a pump it
// moves fluid from a to b if it rotates in the positive sense; as a motor it is driven in this sense if p_a > p_b.
// Along a displacement (a prismatic joint) D is an area.
#pragma once

#include <optional>

#include "mechanism/hydraulics/circuit/ports.hpp"
#include "mechanism/joints/actions/coordinate_action.hpp"
#include "mechanism/measures/time_formula.hpp"
#include "mechanism/model/model.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class Machine final : public CoordinateAction, public TimeDependent {
 public:
  struct Data {
    double displacement;  ///< D [m^3/rad]
    double leakage = 0;   ///< G [m^3/(s Pa)]
    double drag = 0;      ///< d [N m s/rad]
  };
  Machine(std::string name, const Joint& joint, std::size_t coordinate, const PressureNode& from,
          const PressureNode& to, const Data& data);
  void read_setting(const YamlValue& formula, Model& model);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void add_break_points(std::vector<double>& times) const override { setting_.add_break_points(0, times); }
  std::vector<Formula> time_formulas() const override { return time_formulas_of(setting_, "setting", ""); }
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override {
    calc_time_formula(setting_, state, values);
  }
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  /// The names are flow, torque, power.
  std::vector<std::string> measure_names() const override { return {"flow", "torque", "power"}; }
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;

 private:
  friend class MachineMeasure;
  /// Terms of the derivatives of flow and torque.
  struct Turn {
    CoordinateDerivatives& jet;  ///< coordinate of the shaft
    const VectorX& slope;        ///< derivatives of its rate by positions
    FormulaGradient& setting;
  };
  Turn turn(const LocalState& state, FormulaGradient& setting) const;
  void calc_flow(const LocalState& state, const Turn& turn, FlowDerivatives& flow) const;
  void calc_torque(const LocalState& state, const Turn& turn, FlowDerivatives& torque) const;
  double setting(const LocalState& state) const;
  double flow(const LocalState& state, double x, double rate) const;
  double torque(const LocalState& state, double x, double rate) const;
  Data data_;
  Ports ports_;
  StateFormula setting_{1};
};

}  // namespace bielle::mechanism
