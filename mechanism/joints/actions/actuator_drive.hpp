// Drives that act with a force or torque Q on a joint's coordinate: the second node is pushed along it, the first
// pulled.
//
//     Q = s min(max(u, lower), upper),    u what the law asks for (an effort),  s the load factor of a static analysis
// At the limits Q is continuous and its slope jumps: such a kink costs a step O(h^2) of the velocity, once, and leaves
// the order of the scheme. No step ends there: the velocities that u depends on are corrected where a branch begins
// (solvers/README.md), which may lead back across the limit.
#pragma once

#include <limits>

#include "mechanism/joints/actions/drive.hpp"

namespace bielle::mechanism {

/// What a law asks for, with its derivatives over the drive's local layout. Reused from call to call.
struct Effort {
  double value = 0;
  VectorX by_position;  ///< by positions, amplitudes, first-order unknowns and multipliers
  VectorX by_rate;      ///< by velocities and rates
};

/// Ends of the range of a drive's force or torque.
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
  std::unique_ptr<Gatherer> make_gatherer() const final;
  /// Force or torque, and value of the coordinate.
  std::pair<double, double> watched(const LocalState& state) const { return {force(state), value(state).value}; }

 protected:
  virtual double effort(const LocalState& state) const = 0;
  /// @param effort  receives the value and, of an effort that depends on the state, the derivatives
  virtual void calc_effort(const LocalState& state, Effort& effort) const = 0;
  /// Whether the effort has derivatives at all.
  virtual bool reads_state() const = 0;

  void declare_actuator(Declaration& declaration) const;
  const ForceLimit& limit() const { return limit_; }
  /// -1 beyond the lower limit, 1 beyond the upper one, 0 between them. @param u  the effort
  double side(double u) const { return u > limit_.upper ? 1 : u < limit_.lower ? -1 : 0; }
  double limited(double side, double u) const { return side > 0 ? limit_.upper : side < 0 ? limit_.lower : u; }
  double force(const LocalState& state) const final;
  /// "within -5 to 5", or nothing.
  std::string limit_text() const;

 private:
  ForceLimit limit_;
};

/// `limit: 5` or `limit: [-2, 5]`, one end of which may be open (`~`). @throws InputError
ForceLimit read_force_limit(const YamlValue& value);

}  // namespace bielle::mechanism
