// A volume of fluid at one pressure: a hose, a manifold, the chambers that open into it.
//
// Unknowns: the amount of fluid W, measured by its volume at the reference pressure (fluid.hpp); its pressure p; its
// space V.
//     Wdot = sum of f Q        f = 1/v where flows conserve volume, 1 where they conserve mass (Fluid::content)
//     p = p(v = W/V)           by the equation of state
//     V = V_0 + c (p - p_a) + chambers + accumulators        c: compliance of its walls [m^3/Pa]
//
// Flows, chambers and accumulators add to these equations themselves. Because W is integrated instead of p, trapped oil
// is a spring in the stiffness matrix, mass is conserved to rounding, and a pressure never falls to zero: V pdot/B_eff
// = Q - Vdot follows.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "mechanism/hydraulics/circuit/pressure_node.hpp"

namespace bielle::mechanism {

/// Type of a volume that is a part of a pipe.
inline constexpr const char* pipe_cell = "pipe";
/// Type of a volume that is only an end of pipes, and consists of halves of their cells.
inline constexpr const char* pipe_junction = "junction of pipes";

class Volume final : public PressureNode {
 public:
  enum { fluid_row, pressure_row, space_row };
  /// @param volume      V_0 [m^3]; 0 if it consists only of chambers
  /// @param pressure    start pressure [Pa]; no value: it follows from the load of the actuator whose chamber it is
  /// @param compliance  [m^3/Pa]
  /// @param type        type as named by the user
  Volume(std::string name, const Fluid& fluid, double volume, std::optional<double> pressure, double compliance,
         std::string type = "volume");

  /// While the model is read, adds the initial volume of a chamber that opens into it [m^3].
  void add_room(double space) { drawn_ += space; }
  /// While the model is read, adds a volume that depends only on the pressure [m^3], such as an accumulator.
  void add_room(std::function<double(double)> space) { rooms_.push_back(std::move(space)); }
  /// While the model is read, adds a volume of fluid [m^3] and the compliance of its walls [m^3/Pa]: half a cell of a
  /// pipe that ends there.
  void add_volume(double volume, double compliance) {
    volume_ += volume;
    drawn_ += volume;
    compliance_ += compliance;
  }
  double drawn() const;  ///< initial V [m^3], at the start pressure
  /// Records, while the model is read, that no start pressure is given. If the volume is the chamber of exactly one
  /// cylinder, the load determines the start pressure.
  void let_load_decide() { load_decides_ = true; }
  bool load_decides() const { return load_decides_; }
  /// Discards the start pressure, so that it follows from the load of a cylinder.
  void start_by_load() {
    start_.reset();
    load_decides_ = false;
  }
  std::optional<double> start() const { return start_; }  ///< its start pressure, if it is given [Pa]

  /// Returns whether its fluid is not known yet, because at the start of a motion its pressure follows from the load.
  bool waits(const LocalState& own) const {
    return !start_ && own.memory()[0] == 0 && own.first_order()[fluid_row] < 0;
  }
  double space(const LocalState& own) const { return own.first_order()[space_row]; }
  /// Returns the amount of fluid W that fills it at a pressure.
  double fluid_at(double pressure, double space) const { return space / fluid().ratio(pressure).v; }
  /// Returns the net flow into the volume [m^3/s], at its own pressure or the reference pressure, depending on the
  /// conserved quantity.
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
  /// Returns the part of the volume that depends only on the pressure.
  double room_at(double pressure) const;
  /// Returns p(W/V). @throws ComputationError  if the space or the fluid is not positive
  double pressure_by_state(const LocalState& own) const;
  double volume_;
  std::optional<double> start_;
  double compliance_;
  bool load_decides_ = false;
  double drawn_;  ///< initial volume without the part that depends on the pressure [m^3]
  std::vector<std::function<double(double)>> rooms_;
};

}  // namespace bielle::mechanism
