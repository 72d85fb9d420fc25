#include "mechanism/joints/cables/rope_grip.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/measures/turns.hpp"

namespace bielle::mechanism {
namespace {

/// Whether a rope that could slide would initially touch the pulley.
bool touches_as_drawn(const RopePath& before, const RopePath& after) {
  const std::size_t p = before.nodes.size() - 2;
  const RopeCourses around({before.pulleys[p], after.pulleys[0], after.pulleys[1]});
  const std::vector<Frame> at = {before.drawn[p] * before.pulleys[p].on_node, after.drawn[0] * after.pulleys[0].on_node,
                                 after.drawn[1] * after.pulleys[1].on_node};
  return RopeCourses::touches(around.as_drawn(at, {0, 0, 0})[1]);
}

double wrap_as_drawn(const RopeSection& before, const RopeSection& after) {
  const double turn = after.drawn_end(RopeSection::first_end) - before.drawn_end(RopeSection::last_end);
  const double wrap = after.path().pulleys.front().radius < 0 ? -turn : turn;
  if (!touches_as_drawn(before.path(), after.path())) return unwrap_angle(wrap, 0);
  const double less_than_a_turn = unwrap_angle(wrap, M_PI);
  return less_than_a_turn > 2 * M_PI - just_touching ? 0 : less_than_a_turn;  // it just touches
}

}  // namespace

RopeGrip::RopeGrip(const RopeSection& before, const RopeSection& after)
    : Component(after.type(), after.name()),
      before_(before),
      after_(after),
      radius_(after.path().pulleys.front().radius),
      drawn_wrap_(wrap_as_drawn(before, after)) {}

void RopeGrip::declare(Declaration& declaration) const {
  declaration.passive = true;
  declaration.references = {&before_, &after_};
  EventFunction leaves{fmt::format("leaves pulley '{}', which it grips", after_.path().names.front()),
                       EventFunction::Direction::falling};
  leaves.restarts = false;
  declaration.event_functions = {leaves};
}

void RopeGrip::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  thread_local RopeSection::Stretch before, after;
  before_.calc_stretch(state.of(0), before);
  after_.calc_stretch(state.of(1), after);
  const double turned = after.ends[RopeSection::first_end].value - before.ends[RopeSection::last_end].value;
  values[0] = std::abs(radius_) * (drawn_wrap_ + just_touching) + radius_ * turned;
}

std::string RopeGrip::remark() const {
  if (drawn_wrap_ >= 0) return {};
  return fmt::format(
      "drawn clear of pulley '{}', which it grips all the same (a radius of {:.6g} m would turn round it as drawn)",
      after_.path().names.front(), -radius_);
}

}  // namespace bielle::mechanism
