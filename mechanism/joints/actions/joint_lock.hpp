// A coordinate that is locked for an interval of time, at its value when the lock closes.
//
// The lock is a constraint q - q_lock = 0 that is switched on and off (Component::is_on). When the lock closes,
// relative motion is stopped by an inelastic impulse; the lost energy is dissipated. With `release` the lock opens at a
// force, even if the force jumps beyond it. Events may take the place of times. Actions of events close and open the
// lock regardless of its times.
#pragma once

#include <limits>
#include <optional>

#include "mechanism/joints/actions/coordinate_action.hpp"
#include "mechanism/measures/event_record.hpp"

namespace bielle::mechanism {

struct LockTimes {
  double from = 0;                                           ///< [s]
  double to = std::numeric_limits<double>::infinity();       ///< [s]
  double release = std::numeric_limits<double>::infinity();  ///< force or torque that opens it permanently [N], [N m]
};

class JointLock final : public CoordinateAction {
 public:
  JointLock(std::string name, const Joint& joint, std::size_t coordinate, const LockTimes& times)
      : CoordinateAction("lock", std::move(name), joint, coordinate), times_(times) {}
  /// Sets the value of a lock that is closed from the beginning, if the file gives the coordinate's start value.
  void close_at(double value) { start_ = value; }
  /// Closes the lock when an event has occurred, or opens it when one has occurred since it closed, instead of at
  /// times.
  void close_at(const EventRecord& event) { from_event_ = references().add(event); }
  void open_at(const EventRecord& event) { to_event_ = references().add(event); }
  /// Index in the memory of the command of events: 1 closes the lock, -1 opens it, 0 lets its times decide.
  static constexpr int command_place = 2;

  void declare(Declaration& declaration) const override;
  void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const override;
  void add_tangent(const LocalState& state, LocalTangent& tangent) const override;
  void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                            Eigen::Ref<VectorX> acceleration) const override;
  std::vector<OutputField> output_fields() const override;
  void write_output(const LocalState& state, double* values) const override;
  void describe(const LocalState& state, Description& description) const override;
  void add_break_points(std::vector<double>& times) const override;
  void calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const override;
  void begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const override;
  bool leaves_branch(const LocalState& state) const override;
  bool is_on(const LocalState& state, int row) const override;

 private:
  static constexpr double open = 0, locked = 1, released = 2;  ///< status in the memory
  bool is_due(const LocalState& state) const;
  bool is_wanted(const LocalState& state, double command) const { return command == 0 ? is_due(state) : command > 0; }
  double distance(const LocalState& state, double value) const;
  LockTimes times_;
  int from_event_ = -1, to_event_ = -1;  ///< numbers among the references; -1: none
  std::optional<double> start_;
};

}  // namespace bielle::mechanism
