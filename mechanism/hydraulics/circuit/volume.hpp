// A volume of fluid at one pressure: a hose, a manifold, the chambers that open into it.
//
// Unknowns: W, the fluid that it holds, counted by its volume at the reference pressure (fluid.hpp); its pressure p;
// the space V that it has.
//     Wdot = sum of f Q        f = 1/v where flows conserve volume, 1 where they conserve mass (Fluid::content)
//     p = p(v = W/V)           by the equation of state
//     V = V_0 + c (p - p_a) + chambers + accumulators        c: the compliance of its walls [m^3/Pa]
//
// Flows, chambers and accumulators add to these equations themselves. With W in place of p as what is integrated, oil
// that is trapped is a spring in the stiffness matrix, mass is conserved to rounding, and a pressure never falls to
// zero: V pdot/B_eff = Q - Vdot follows.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "mechanism/hydraulics/circuit/pressure_node.hpp"

namespace bielle::mechanism {

/// The type of a volume that is a part of a pipe.
inline constexpr const char* pipe_cell = "pipe";
/// The type of a volume that is nothing but an end of pipes, and is made of halves of their cells.
inline constexpr const char* pipe_junction = "junction of pipes";

class Volume final : public PressureNode {
 public:
  enum { fluid_row, pressure_row, space_row };
  /// @param volume      V_0 [m^3]; 0 where chambers alone make it
  /// @param pressure    at the start [Pa]; none: it follows from the load of the actuator whose chamber it is
  /// @param compliance  [m^3/Pa]
  /// @param type        what the user calls it
  Volume(std::string name, const Fluid& fluid, double volume, std::optional<double> pressure, double compliance,
         std::string type = "volume");

  /// While the model is read: a chamber that opens into it, with its space as drawn [m^3].
  void add_room(double space) { drawn_ += space; }
  /// The same of what has a space that depends on the pressure alone [m^3]: an accumulator.
  void add_room(std::function<double(double)> space) { rooms_.push_back(std::move(space)); }
  /// Likewise: fluid that belongs to it, and by how much its walls give [m^3/Pa] (half a cell of a pipe that ends
  /// there).
  void add_volume(double volume, double compliance) {
    volume_ += volume;
    drawn_ += volume;
    compliance_ += compliance;
  }
  double drawn() const;  ///< V as drawn [m^3], at the pressure of the start
  /// Likewise: nobody gives its pressure at the start. Where it is the chamber of one cylinder alone, the load decides.
  void let_load_decide() { load_decides_ = true; }
  bool load_decides() const { return load_decides_; }
  /// A cylinder decides.
  void start_by_load() {
    start_.reset();
    load_decides_ = false;
  }
  std::optional<double> start() const { return start_; }  ///< its pressure at the start, if it is given [Pa]

  /// Whether its fluid is not known yet: a motion begins, and its pressure follows from the load.
  bool waits(const LocalState& own) const {
    return !start_ && own.memory()[0] == 0 && own.first_order()[fluid_row] < 0;
  }
  double space(const LocalState& own) const { return own.first_order()[space_row]; }
  /// The fluid that fills it at a pressure: W.
  double fluid_at(double pressure, double space) const { return space / fluid().ratio(pressure).v; }
  /// The flow that changes its fluid [m^3/s], at its pressure or the reference pressure, as flows are counted.
  double net_flow(const LocalState& own) const;

  bool is_part() const override { return type() == pipe_cell; }
  bool balances(const LocalState& own) const override { return !own.environment().statics; }
  Exchange exchange(const LocalState& own) const override;

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_start_values(const LocalState& state, Eigen::Ref<VectorX> change) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;

 private:
  /// What of the space depends on the pressure alone.
  double room_at(double pressure) const;
  /// p(W/V). @throws ComputationError  nothing is left of the space or of the fluid
  double pressure_by_state(const LocalState& own) const;
  double volume_;
  std::optional<double> start_;
  double compliance_;
  bool load_decides_ = false;
  double drawn_;  ///< without what depends on the pressure
  std::vector<std::function<double(double)>> rooms_;
};

}  // namespace bielle::mechanism
