#include "mechanism/joints/actions/joint_lock.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

void JointLock::declare(Declaration& declaration) const {
  declare_references(declaration);
  Declaration::Scalar row{coordinate().name + " locked", coordinate().force_units()};
  row.switched = true;
  declaration.multipliers.push_back(row);
  declaration.memory = {open, 0, 0};  // status, locked value of the coordinate, command of events
  if (!std::isfinite(times_.release)) return;
  EventFunction release{coordinate().name + " is released", EventFunction::Direction::rising};
  release.begins_on = -1;
  release.reads_reaction = true;
  declaration.event_functions = {release};
}

double JointLock::distance(const LocalState& state, double value) const {
  const double away = value - state.memory()[1];
  return coordinate().kind == JointCoordinate::Kind::angle ? std::remainder(away, 2 * M_PI) : away;
}

void JointLock::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  CoordinateSlopes& slopes = calc_slopes(state);
  add_kept(state, slopes, distance(state, slopes.principal), r);
}

void JointLock::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (tangent.wants_K) add_kept_tangent(state, calc(state), tangent);
}

void JointLock::add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                     Eigen::Ref<VectorX> acceleration) const {
  const auto [first, second] = calc_kept_rates(state);
  velocity[0] += first;
  acceleration[0] += second;
}

void JointLock::describe(const LocalState& /*state*/, Description& description) const {
  std::string text = coordinate().name + " locked";
  if (from_event_ >= 0)
    text += " from an event on";
  else if (std::isinf(times_.from))
    text += " by events";
  else if (times_.from > 0)
    text += fmt::format(" from {:.6g} s", times_.from);
  if (to_event_ >= 0) text += " until an event";
  if (std::isfinite(times_.to)) text += fmt::format(" to {:.6g} s", times_.to);
  if (std::isfinite(times_.release))
    text += fmt::format(", released at {:.6g} {}", times_.release, coordinate().force_units());
  description.add_line(text);
}

std::vector<OutputField> JointLock::output_fields() const {
  return {force_field("lock_force", "force or torque of the lock along the joint's coordinates")};
}

void JointLock::write_output(const LocalState& state, double* values) const {
  write_force(-state.reaction()[0], values);
}

void JointLock::add_break_points(std::vector<double>& times) const {
  for (const double time : {times_.from, times_.to})
    if (std::isfinite(time)) times.push_back(time);
}

void JointLock::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  if (values.size() > 0) values[0] = std::abs(state.reaction()[0]) - times_.release;
}

bool JointLock::is_due(const LocalState& state) const {
  double from = times_.from;
  if (from_event_ >= 0) {
    if (!EventRecord::has_happened(state.of(from_event_))) return false;
    from = EventRecord::time(state.of(from_event_));
  }
  if (state.time() < from) return false;
  if (to_event_ < 0) return state.time() < times_.to;
  const LocalState end = state.of(to_event_);
  return !EventRecord::has_happened(end) || EventRecord::time(end) < from;
}

/// This is only possible if steps do not end on break points.
bool JointLock::leaves_branch(const LocalState& state) const {
  const double status = state.memory()[0];
  return status != released && is_wanted(state, state.memory()[command_place]) != (status == locked);
}

void JointLock::begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const {
  double& command = memory[command_place];
  if (!crossed.empty()) {
    memory[0] = released;
    command = 0;
  }
  if (memory[0] == released && command > 0) memory[0] = open;  // an event may close it again
  if (memory[0] == released) return;
  const bool now = is_wanted(state, command);
  if (now && memory[0] == open) memory[1] = start_ ? *start_ : value(state).value;
  memory[0] = now ? locked : open;
}

bool JointLock::is_on(const LocalState& state, int /*row*/) const { return state.memory()[0] == locked; }

}  // namespace bielle::mechanism
