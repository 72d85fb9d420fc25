#include "mechanism/joints/cables/rope_grip.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace bielle::mechanism {

RopeGrip::RopeGrip(const RopeSection& before, const RopeSection& after, RopeWrap wrap, bool slips)
    : Component(after.type(), after.name()), before_(before), after_(after), wrap_(std::move(wrap)), slips_(slips) {}

void RopeGrip::declare(Declaration& declaration) const {
  declaration.passive = true;
  declaration.references = {&before_, &after_};
  EventFunction leaves{
      fmt::format("leaves pulley '{}', {}", wrap_.pulley(), slips_ ? "on which it is kept" : "which it grips"),
      EventFunction::Direction::falling};
  leaves.restarts = false;
  declaration.event_functions = {leaves};
}

void RopeGrip::calc_event_functions(const LocalState& state, Eigen::Ref<VectorX> values) const {
  thread_local RopeSection::Stretch before, after;
  before_.calc_stretch(state.of(0), before);
  after_.calc_stretch(state.of(1), after);
  values[0] = std::abs(wrap_.radius()) * (wrap_.value(before, after) + just_touching);
}

std::string RopeGrip::remark() const {
  if (wrap_.drawn() >= 0) return {};
  return fmt::format("drawn clear of pulley '{}', {} all the same (a radius of {:.6g} m would turn round it as drawn)",
                     wrap_.pulley(), slips_ ? "on which it is kept" : "which it grips", -wrap_.radius());
}

}  // namespace bielle::mechanism
