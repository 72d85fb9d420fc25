// Drives that act with a force or torque Q on a joint's coordinate: the second node is pushed along it, the first
// pulled.
//
//     Q = s min(max(u, lower), upper),    u what the law asks for (an effort),  s the load factor of a static analysis
// At the limits the law changes: steps end there (crossings). Which branch a step is computed on, between the limits
// or at one of them, stands in the memory; static analyses take it from u itself.
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
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_energy(const LocalState& state, Energy& energy) const final;
  void calc_crossings(const LocalState& state, Eigen::Ref<VectorX> values) const final;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const final;
  bool leaves_branch(const LocalState& state) const final;

 protected:
  virtual double effort(const LocalState& state) const = 0;
  /// @param effort  receives the value and, of an effort that depends on the state, the derivatives
  virtual void calc_effort(const LocalState& state, Effort& effort) const = 0;
  /// Whether the effort has derivatives at all.
  virtual bool reads_state() const = 0;

  void declare_actuator(Declaration& declaration) const;
  const ForceLimit& limit() const { return limit_; }
  /// -1 at the lower limit, 1 at the upper one, 0 between them. @param u  the effort
  double side(const LocalState& state, double u) const;
  double limited(double side, double u) const { return side > 0 ? limit_.upper : side < 0 ? limit_.lower : u; }
  /// How many numbers of the memory are taken.
  Eigen::Index actuator_memory() const { return own_memory() + (limit_.limits() ? 1 : 0); }
  double force(const LocalState& state) const final;
  /// "within -5 to 5", or nothing.
  std::string limit_text() const;

 private:
  double side_of(double u) const { return u > limit_.upper ? 1 : u < limit_.lower ? -1 : 0; }
  ForceLimit limit_;
};

/// `limit: 5` or `limit: [-2, 5]`, one end of which may be open (`~`). @throws InputError
ForceLimit read_force_limit(const YamlValue& value);

}  // namespace bielle::mechanism
