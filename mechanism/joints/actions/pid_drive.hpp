// A motor with a PID controller: a torque or force on a joint's coordinate that controls the coordinate c itself, or a
// measure, to a target.
//
//     e = target - controlled,     u = kp e + ki z + kd D,     Q = min(max(u, lower), upper)
//     z' = e + (Q - u)/(ki T_w)                         integral; with anti-windup by back-calculation at a limit
//     d' = (e - d)/T_f,  D = (e - d)/T_f                derivative, with a filter of time constant T_f
//     D = d(target)/dt - cdot                           derivative without filter, if the target is a function of time
//
// z and d are first-order unknowns. z begins at zero, d at e, so that the derivative term has no initial peak. At a
// limit z moves to the value at which u is at the limit, within T_w (`tracking_time`, by default kp/ki). After its
// release the drive keeps z.
// In a static analysis all rates are zero, including that of z: e = 0 if nothing else holds the coordinate.
//
// Reference: K. J. Astroem, T. Haegglund, PID Controllers: Theory, Design and Tuning, 1995, 3.5.
#pragma once

#include <optional>

#include "mechanism/joints/actions/actuator_drive.hpp"
#include "mechanism/measures/state_formula.hpp"
#include "mechanism/model/time_dependent.hpp"
#include "mechanism/reading/pid_gains.hpp"

namespace bielle::mechanism {

class PidDrive final : public ActuatorDrive, public TimeDependent {
 public:
  /// @param tracking_time  T_w [s]; not used without integral or limit
  PidDrive(std::string name, const Joint& joint, std::size_t coordinate, const ForceLimit& limit, const PidGains& gains,
           double tracking_time)
      : ActuatorDrive(std::move(name), joint, coordinate, limit), gains_(gains), tracking_time_(tracking_time) {}
  /// Reads its formulas, after the model has been read. @param measure  controlled measure; if empty, the coordinate
  /// itself
  void read(const YamlValue& target, const std::optional<YamlValue>& measure, Model& model);

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_start_values(const LocalState& state, Eigen::Ref<VectorX> change) const override;
  void accept(const LocalState& state, Eigen::Ref<VectorX> memory) const override;
  std::vector<Formula> time_formulas() const override;
  void calc_time_formulas(const LocalState& state, std::span<double> values) const override;

 private:
  /// Values of the controller at a state.
  struct Loop {
    double error, derivative, effort;
  };
  Loop loop(const LocalState& state) const;
  double effort(const LocalState& state) const override { return loop(state).effort; }
  void calc_effort(const LocalState& state, Effort& effort) const override;
  /// Computes the error with its derivatives, in the form of an Effort.
  void calc_error(const LocalState& state, Effort& error) const;
  double target_rate(const LocalState& state) const;
  bool reads_state() const override { return true; }
  void add_kinks(std::vector<double>& times) const override { target_.add_break_points(0, times); }
  LawText law_text() const override;

  bool integrates() const { return gains_.integral != 0; }
  bool filters() const { return gains_.derivative != 0 && gains_.filter > 0; }
  int filter_row() const { return integrates() ? 1 : 0; }
  /// Tells whether z keeps its value in a static analysis, so that its row contains only its increment.
  bool keeps_integral(const LocalState& state) const;
  /// Returns z' - e, which is zero between the limits. @param side,u  values of the actuator
  double windup_rate(double side, double u) const;

  PidGains gains_;
  double tracking_time_;
  StateFormula target_;
  const Measure* measure_ = nullptr;
  int measure_reference_ = 0;
};

}  // namespace bielle::mechanism
