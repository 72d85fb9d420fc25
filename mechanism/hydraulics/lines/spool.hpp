// The spool of a valve: dynamics of its opening y for the command u(t, measures).
//
//   none:           y = u
//   first order:    T ydot = u - y
//   second order:   ydot = w,   wdot = omega^2 (u - y) - 2 zeta omega w
// y and w are first-order unknowns of the valve of the spool, beginning with its first one. The spool starts at its
// command, and stays there in a static analysis. Events may lock the opening (opening_lock.hpp).
#pragma once

#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/references.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

class Spool {
 public:
  /// @param least  smallest opening: -1 for a valve with two directions, 0 for one that only opens
  explicit Spool(double least) : least_(least) {}
  /// Reads `time_constant`, or `frequency` [Hz] and `damping`, of a map that is bound to a table with spool_keys.
  /// @throws InputError
  void read_dynamics(const YamlValue& entry);
  /// Reads `command`. Call it within Model::when_read(Stage::formulas).
  void read_command(const YamlValue& command, Model& model, References& references);

  int order() const { return order_; }
  bool reads_state() const { return command_.reads_state(); }
  bool reads_reactions() const { return command_.reads_reactions(); }
  void declare(Declaration& declaration) const;
  /// Returns the opening, with its derivatives over the owner's local layout. @param gradient  prepared, zero on entry
  double opening(const LocalState& state, MeasureGradient& gradient) const;
  double opening(const LocalState& state) const;
  /// Returns the speed of a spool of second order, otherwise zero [1/s].
  double speed(const LocalState& state) const { return order_ == 2 ? state.first_order()[1] : 0; }
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const;
  void add_pattern(const Slots& slots, LocalPattern& pattern) const;
  void add_start_values(const LocalState& state, Eigen::Ref<VectorX> change) const;
  /// Checks the command that the spool follows. @throws ComputationError if it is beyond the ends of the spool
  /// @param name  name of the valve
  void check(const LocalState& state, const std::string& name) const;
  void add_break_points(std::vector<double>& times) const { command_.add_break_points(0, times); }
  const StateFormula& command_formula() const { return command_; }
  std::string describe() const;

 private:
  double command(const LocalState& state) const;
  double least_;
  int order_ = 0;
  double time_constant_ = 0;        ///< T [s]
  double omega_ = 0, damping_ = 0;  ///< omega [rad/s], zeta
  StateFormula command_;
};

/// Returns `command`, `overlap`, `time_constant`, `frequency`, `damping`.
/// @param least  smallest opening @param command  sentence that describes the command
std::vector<Key> spool_keys(double least, const std::string& command);
/// Returns the key `time_constant` of a valve.
Key time_constant_key();

}  // namespace bielle::mechanism
