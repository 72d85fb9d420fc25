// Drives, which move a joint's coordinate c.
//
//   angle or displacement (t):  constraint c(q) - f(t) = 0, motion_drive.hpp
//   rate or speed (t):          constraint cdot - f(t) = 0, motion_drive.hpp
//   torque or force:            a formula of t and the state, force_drive.hpp
//   torque or force, sought:    determined by inverse dynamics for the motion of nodes, sought_drive.hpp
//   pid:                        a controller with its own states, pid_drive.hpp
//   motor:                      a direct-current motor with its current, motor_drive.hpp
//
// Each drive may release its joint: at a time, or when a measure crosses a value. From then on it has no effect.
#pragma once

#include <limits>

#include "mechanism/joints/actions/coordinate_action.hpp"
#include "mechanism/model/measure.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Common base of all drives: a law on one coordinate of a joint. The forces of all drives of one joint are recorded
/// together.
///
/// Memory: [whether it has been released, if this is possible (see released)], followed by the memory of the kind of
/// drive.
class Drive : public CoordinateAction {
 public:
  Drive(std::string name, const Joint& joint, std::size_t coordinate)
      : CoordinateAction("drive", std::move(name), joint, coordinate) {}
  /// Sets the time at which the drive is released [s].
  void release_at(double time) { release_time_ = time; }
  /// Releases the drive when the measure crosses a value. The function is called once after the model has been read.
  void release_when(const Measure& measure, double value, EventFunction::Direction direction);

  /// Adds `force` along the coordinate, and its power. Drives that prescribe a motion by a constraint have rows
  /// instead.
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_energy(const LocalState& state, Energy& energy) const override;

  std::vector<OutputField> output_fields() const final;
  void write_output(const LocalState& state, double* values) const final { write_force(force(state), values); }
  void describe(const LocalState& state, Description& description) const final;
  void add_break_points(std::vector<double>& times) const final;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const final;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const final;
  bool leaves_branch(const LocalState& state) const final;

 protected:
  virtual double force(const LocalState& state) const = 0;  ///< force along the coordinate [N] or [N m]
  /// Adds the times at which the law has kinks.
  virtual void add_kinks(std::vector<double>& times) const = 0;
  /// Driven quantity, law as written by the user, and units: {"rate of angle", "speed*t", "rad/s"}.
  struct LawText {
    std::string driven, law, units;
  };
  virtual LawText law_text() const = 0;

  /// Declares references, a stiffness, and the memory and event functions of the release, which come first.
  void declare_drive(Declaration& declaration) const;
  bool can_release() const { return release_measure_ || release_time_ < std::numeric_limits<double>::infinity(); }
  bool released(const LocalState& state) const { return can_release() && state.memory()[0] != 0; }
  /// Returns the number of memory entries that are used by this class.
  Eigen::Index own_memory() const { return can_release() ? 1 : 0; }

 private:
  double release_time_ = std::numeric_limits<double>::infinity();  ///< [s]
  const Measure* release_measure_ = nullptr;
  int release_reference_ = 0;
  double release_value_ = 0;
  EventFunction::Direction release_direction_ = EventFunction::Direction::both;
};

const KeyTable& drive_keys();
/// Reads an entry of `drives`: `{joint: main, angle: "speed*t"}`.
void read_drive(const std::string& name, const YamlValue& entry, Model& model);

}  // namespace bielle::mechanism
