#include "mechanism/joints/actions/drive.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mechanism/model/description.hpp"

namespace bielle::mechanism {

void Drive::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  const double Q = force(state);
  if (Q == 0) return;
  CoordinateSlopes& slopes = calc_slopes(state);
  r.segment(row(state), slopes.w().size()) -= Q * slopes.w();
}

void Drive::add_energy(const LocalState& state, Energy& energy) const {
  energy.input += force(state) * value(state).rate;
}

std::vector<OutputField> Drive::output_fields() const {
  return {
      force_field("drive_force", "force or torque of the drives along the joint's coordinates; zero where none acts")};
}

void Drive::describe(const LocalState& /*state*/, Description& description) const {
  const LawText text = law_text();
  description.add(fmt::format("{} of joint '{}' is {} [{}]", text.driven, joint().name(), text.law, text.units));
  if (release_measure_)
    description.add(fmt::format("lets go where {} crosses {:.6g} {}", release_measure_->name(), release_value_,
                                release_measure_->units()));
  else if (can_release())
    description.add(fmt::format("lets go at {:.6g} s", release_time_));
}

// -- release

void Drive::release_when(const Measure& measure, double value, EventFunction::Direction direction) {
  release_measure_ = &measure;
  release_reference_ = references().add(measure);
  release_value_ = value;
  release_direction_ = direction;
}

void Drive::declare_drive(Declaration& declaration) const {
  declare_references(declaration);
  if (!can_release()) return;
  declaration.memory.push_back(0);
  if (!release_measure_) return;
  EventFunction release{"lets go of its joint", release_direction_};
  release.reads_reaction = release_measure_->reads_reactions();
  declaration.event_functions.push_back(release);
}

void Drive::add_break_points(std::vector<double>& times) const {
  if (release_time_ < std::numeric_limits<double>::infinity()) times.push_back(release_time_);
  add_kinks(times);
}

void Drive::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  if (!release_measure_) return;
  // The event occurs only once: after the release the value stays on its side.
  values[0] =
      released(state) ? state.memory()[0] : release_measure_->value(state.of(release_reference_)) - release_value_;
}

void Drive::begin_branch(const LocalState& state, std::span<const int> crossed, Eigen::Ref<VectorX> memory) const {
  if (!can_release() || memory[0] != 0) return;
  if (!release_measure_) {
    memory[0] = state.time() >= release_time_ ? 1 : 0;
  } else if (std::find(crossed.begin(), crossed.end(), 0) != crossed.end()) {
    const double beyond = release_measure_->value(state.of(release_reference_)) - release_value_;
    memory[0] = beyond < 0 ? -1 : 1;
  }
}

/// This is only possible if steps do not end on break points.
bool Drive::leaves_branch(const LocalState& state) const {
  return can_release() && !release_measure_ && state.memory()[0] == 0 && state.time() >= release_time_;
}

}  // namespace bielle::mechanism
