#include "mechanism/joints/actions/actuator_drive.hpp"

#include <fmt/format.h>

#include "mechanism/joints/actions/still_watch.hpp"

namespace bielle::mechanism {

void ActuatorDrive::declare_actuator(Declaration& declaration) const {
  declare_drive(declaration);
  declaration.damping = reads_state();
  declaration.kinks = limit_.limits();
}

double ActuatorDrive::force(const LocalState& state) const {
  if (released(state)) return 0;
  const double u = effort(state);
  return state.environment().load_factor * limited(side(u), u);
}

void ActuatorDrive::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  if (released(state) || (!tangent.wants_K && !(tangent.wants_C && reads_state()))) return;
  thread_local Effort effort;
  calc_effort(state, effort);
  const double factor = state.environment().load_factor, side = this->side(effort.value);
  CoordinateDerivatives& jet = calc(state);
  const int at = row(state);
  const auto n = jet.w().size();
  if (tangent.wants_K) tangent.K.dense().block(at, at, n, n) -= factor * limited(side, effort.value) * jet.W();
  if (!reads_state() || side != 0) return;
  if (tangent.wants_K) tangent.K.dense().middleRows(at, n) -= factor * jet.w() * effort.by_position.transpose();
  if (tangent.wants_C) tangent.C.dense().middleRows(at, n) -= factor * jet.w() * effort.by_rate.transpose();
}

std::unique_ptr<StepRecorder> ActuatorDrive::make_step_recorder() const { return std::make_unique<StillWatch>(*this); }

// -- limits

std::string ActuatorDrive::limit_text() const {
  if (!limit_.limits()) return {};
  if (!limit_.has_lower()) return fmt::format(", at most {:.6g}", limit_.upper);
  if (!limit_.has_upper()) return fmt::format(", at least {:.6g}", limit_.lower);
  return fmt::format(", from {:.6g} to {:.6g}", limit_.lower, limit_.upper);
}

ForceLimit read_force_limit(const YamlValue& value) {
  if (!value.is_sequence()) {
    const double most = value.number();
    return {-most, most};
  }
  if (value.size() != 2) value.fail("expected a number, or [lower, upper]");
  ForceLimit limit;
  const YamlValue lower = value.at(std::size_t{0}), upper = value.at(std::size_t{1});
  if (!lower.is_null()) limit.lower = lower.number();
  if (!upper.is_null()) limit.upper = upper.number();
  if (!(limit.lower < limit.upper)) value.fail("expected the lower limit first, and a range between the two");
  if (!limit.limits()) value.fail("both ends are open: this is no limit");
  return limit;
}

}  // namespace bielle::mechanism
