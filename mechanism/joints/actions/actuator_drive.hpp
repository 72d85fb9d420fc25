// Drives that act with a force or torque Q on a joint's coordinate: it pushes the second node along the coordinate, and
// pulls the first.
//
//     Q = s min(max(u, lower), upper),    u the effort required by the law,  s the load factor of a static analysis
// At the limits Q is continuous and its slope jumps. Such a kink causes a single error of O(h^2) in the velocity and
// does not change the order of the scheme. No step ends at a limit, because the velocities that u depends on are
// corrected at the beginning of a branch (solvers/README.md), and this may lead back across the limit.
#pragma once

#include <limits>

#include "mechanism/joints/actions/drive.hpp"

namespace bielle::mechanism {

/// The effort required by a law, with its derivatives over the drive's local layout. The object is reused from call to
/// call.
struct Effort {
  double value = 0;
  VectorX by_position;  ///< derivatives by positions, amplitudes, first-order unknowns and multipliers
  VectorX by_rate;      ///< derivatives by velocities and rates
};

/// Range of a drive's force or torque.
struct ForceLimit {
  double lower = -std::numeric_limits<double>::infinity();  ///< [N] or [N m]
  double upper = std::numeric_limits<double>::infinity();
  bool limits() const { return lower > -std::numeric_limits<double>::infinity() || has_upper(); }
  bool has_lower() const { return lower > -std::numeric_limits<double>::infinity(); }
  bool has_upper() const { return upper < std::numeric_limits<double>::infinity(); }
};

class ActuatorDrive : public Drive {
 public:
  ActuatorDrive(std::string name, const Joint& joint, std::size_t coordinate, const ForceLimit& limit)
      : Drive(std::move(name), joint, coordinate), limit_(limit) {}
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  std::unique_ptr<StepRecorder> make_step_recorder() const final;
  /// Returns the force or torque and the value of the coordinate.
  std::pair<double, double> watched(const LocalState& state) const { return {force(state), value(state).value}; }

 protected:
  virtual double effort(const LocalState& state) const = 0;
  /// @param effort  receives the value and, if the effort depends on the state, the derivatives
  virtual void calc_effort(const LocalState& state, Effort& effort) const = 0;
  /// Tells whether the effort has derivatives.
  virtual bool reads_state() const = 0;

  void declare_actuator(Declaration& declaration) const;
  const ForceLimit& limit() const { return limit_; }
  /// Returns -1 beyond the lower limit, 1 beyond the upper one, 0 between them. @param u  effort
  double side(double u) const { return u > limit_.upper ? 1 : u < limit_.lower ? -1 : 0; }
  double limited(double side, double u) const { return side > 0 ? limit_.upper : side < 0 ? limit_.lower : u; }
  double force(const LocalState& state) const final;
  /// Returns "within -5 to 5", or an empty text.
  std::string limit_text() const;

 private:
  ForceLimit limit_;
};

/// Reads `limit: 5` or `limit: [-2, 5]`, in which one end may be open (`~`). @throws InputError
ForceLimit read_force_limit(const YamlValue& value);

}  // namespace bielle::mechanism
