// Accumulator with gas behind a bladder or piston in a volume of the circuit.
//
// The gas volume is V_g = V_0 (p_0/p)^(1/n) above its precharge pressure p_0 (absolute), with n = 1 (slow) to 1.4
// (fast, adiabatic); below p_0 the bladder fills the shell, V_g = V_0. The rest of the shell belongs to the space of
// the volume:
//     V_acc(p) = V_0 - V_g(p),       energy = integral of (p - p_a) dV_acc.
// V_acc has a kink at the precharge, where the compliance of a stiff volume may grow a thousandfold: Newton's method
// would jump from one side to the other. A motion therefore computes each step on one side, which stands in the memory:
// filled (continued below p_0 by its tangent) or empty (V_acc = 0), and ends steps where p passes p_0. Analyses without
// events, and the start of the first motion, take the side of the present pressure.
#pragma once

#include "mechanism/hydraulics/circuit/volume.hpp"
#include "mechanism/model/measure.hpp"
#include "mechanism/model/references.hpp"

namespace bielle::mechanism {

class Accumulator final : public Component {
 public:
  /// @param gas_volume  V_0 [m^3] @param precharge  p_0 [Pa], like the user's pressures @param exponent  n
  Accumulator(std::string name, Volume& volume, double gas_volume, double precharge, double exponent);
  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_pattern(const Slots& slots, LocalPattern& pattern) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  bool leaves_branch(const LocalState& state) const override;
  bool knows_memory(const LocalState& state) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  std::vector<std::string> measure_names() const override { return {"fluid_volume"}; }
  std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const override;

 private:
  friend class AccumulatorMeasure;
  static constexpr double empty = 0, filled = 1, undecided = 2;  ///< side in the memory
  struct Space {
    double V = 0, V_p = 0;
    double work = 0;  ///< integral of the absolute pressure dV [J]
  };
  double pressure(const LocalState& state) const { return volume_.pressure(state.of(0)); }
  /// Returns the side on which the equations are evaluated.
  double side(const LocalState& state) const;
  double side_of(double p) const { return p < precharge_ ? empty : filled; }
  /// Returns the difference of the pressure and the pressure at which the present side ends [Pa]; it is positive for a
  /// filled accumulator.
  double way_to_empty(const LocalState& state) const;
  Space space(double p, double side) const;
  Space space(const LocalState& state) const { return space(pressure(state), side(state)); }
  double absolute(double p) const { return p + (volume_.fluid().ambient == 0 ? Fluid::atmosphere : 0); }
  const Volume& volume_;
  References references_;
  double gas_volume_, precharge_, exponent_;
};

}  // namespace bielle::mechanism
