#include "mechanism/joints/actions/pid_drive.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/measures/read_measure.hpp"

namespace bielle::mechanism {

void PidDrive::read(const YamlValue& target, const std::optional<YamlValue>& measure, Model& model) {
  if (measure) {
    measure_ = &measure_named_by(*measure, model);
    measure_reference_ = references().add(*measure_);
  }
  target_ = read_state_formula(target, {"t"}, model, references());
  if (gains_.derivative != 0 && gains_.filter == 0 && target_.reads_state())
    target.fail(
        "depends on the state, so that its rate is not known: give the controller a `filter` [s] for the derivative, "
        "or "
        "`kd: 0`");
}

void PidDrive::declare(Declaration& declaration) const {
  declare_actuator(declaration);
  declaration.reads_reactions = target_.reads_reactions() || (measure_ && measure_->reads_reactions());
  const std::string units = measure_ ? measure_->units() : coordinate().units();
  if (integrates()) {
    const double largest =
        std::max(std::abs(limit().has_upper() ? limit().upper : 0), std::abs(limit().has_lower() ? limit().lower : 0));
    Declaration::Scalar integral{"integral of the error", units == "-" || units.empty() ? "s" : units + " s"};
    integral.scale = largest > 0                ? largest / std::abs(gains_.integral)
                     : gains_.proportional != 0 ? std::abs(gains_.proportional / gains_.integral)
                                                : 1;
    integral.equation_units = units;
    integral.holdable = true;
    declaration.first_order.push_back(std::move(integral));
    declaration.starts_by_state = true;
  }
  if (filters()) {
    Declaration::Scalar filtered{"filtered error", units};
    filtered.scale = 1;
    declaration.first_order.push_back(std::move(filtered));
    declaration.starts_by_state = true;
    declaration.memory.push_back(0);  // tells whether the controller has begun
  }
}

// -- the controller

double PidDrive::target_rate(const LocalState& state) const {
  if (state.environment().statics) return 0;
  const double t = state.time();
  thread_local FormulaGradient gradient;
  target_.calc(state, {&t, 1}, gradient);
  return gradient.by_variable[0];
}

PidDrive::Loop PidDrive::loop(const LocalState& state) const {
  const double t = state.time();
  const CoordinateRate own = value(state);
  const double controlled = measure_ ? measure_->value(state.of(measure_reference_)) : own.value;
  Loop loop{target_.value(state, {&t, 1}) - controlled, 0, 0};
  if (filters())
    loop.derivative = (loop.error - state.first_order()[filter_row()]) / gains_.filter;
  else if (gains_.derivative != 0)
    loop.derivative = target_rate(state) - own.rate;
  loop.effort = gains_.proportional * loop.error + gains_.derivative * loop.derivative;
  if (integrates()) loop.effort += gains_.integral * state.first_order()[0];
  return loop;
}

void PidDrive::calc_error(const LocalState& state, Effort& error) const {
  const double t = state.time();
  thread_local FormulaGradient target;
  thread_local MeasureGradient controlled;
  target_.calc(state, {&t, 1}, target);
  error.value = target.value;
  if (target_.reads_state()) {
    error.by_position = target.by_state.position();
    error.by_rate = target.by_state.rate();
  } else {
    error.by_position.setZero(state.slots().size());
    error.by_rate.setZero(state.slots().size());
  }
  if (measure_) {
    const LocalState of_measure = state.of(measure_reference_);
    error.value -= measure_->calc(of_measure, controlled);
    const int at = state.slots().reference_row(measure_reference_), size = of_measure.slots().size();
    error.by_position.segment(at, size) -= controlled.position();
    error.by_rate.segment(at, size) -= controlled.rate();
  } else {
    CoordinateSlopes& slopes = calc_slopes(state);
    error.value -= slopes.value;
    error.by_position.segment(row(state), slopes.g().size()) -= slopes.g();
  }
}

void PidDrive::calc_effort(const LocalState& state, Effort& effort) const {
  calc_error(state, effort);
  const double kp = gains_.proportional, kd = gains_.derivative;
  if (filters()) {
    const double gain = kp + kd / gains_.filter;
    effort.value = kp * effort.value + kd * (effort.value - state.first_order()[filter_row()]) / gains_.filter;
    effort.by_position *= gain;
    effort.by_rate *= gain;
    effort.by_position[filter_row()] -= kd / gains_.filter;
  } else {
    effort.value *= kp;
    effort.by_position *= kp;
    effort.by_rate *= kp;
    if (kd != 0) {
      CoordinateDerivatives& jet = calc(state);
      const int at = row(state);
      const auto n = jet.w().size();
      effort.value += kd * (target_rate(state) - jet.rate);
      effort.by_position.segment(at, n) -= kd * rate_slope(state, jet);
      effort.by_rate.segment(at, n) -= kd * jet.w();
    }
  }
  if (!integrates()) return;
  effort.value += gains_.integral * state.first_order()[0];
  effort.by_position[0] += gains_.integral;
}

// -- states of the controller

bool PidDrive::keeps_integral(const LocalState& state) const {
  return state.held(0) || (state.environment().statics && released(state));
}

double PidDrive::windup_rate(double side, double u) const {
  return side == 0 ? 0 : (limited(side, u) - u) / (gains_.integral * tracking_time_);
}

void PidDrive::add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const {
  Drive::add_residual(state, r);
  if (!integrates() && !filters()) return;
  const Loop now = loop(state);
  if (integrates() && !keeps_integral(state)) {
    r[0] += state.first_order_rate()[0];
    if (!released(state)) r[0] -= now.error + windup_rate(side(now.effort), now.effort);
  }
  if (filters()) r[filter_row()] += state.first_order_rate()[filter_row()] - now.derivative;
}

void PidDrive::add_tangent(const LocalState& state, LocalTangent& tangent) const {
  ActuatorDrive::add_tangent(state, tangent);
  if ((!integrates() && !filters()) || (!tangent.wants_K && !tangent.wants_C)) return;
  thread_local Effort error, effort;
  calc_error(state, error);
  if (integrates() && keeps_integral(state)) {
    if (tangent.wants_K) tangent.K.dense()(0, 0) += 1;
  } else if (integrates()) {
    if (tangent.wants_C) tangent.C.dense()(0, 0) += 1;
    if (!released(state)) {
      if (tangent.wants_K) tangent.K.dense().row(0) -= error.by_position.transpose();
      if (tangent.wants_C) tangent.C.dense().row(0) -= error.by_rate.transpose();
      calc_effort(state, effort);
      if (side(effort.value) != 0) {
        const double factor = 1 / (gains_.integral * tracking_time_);
        if (tangent.wants_K) tangent.K.dense().row(0) += factor * effort.by_position.transpose();
        if (tangent.wants_C) tangent.C.dense().row(0) += factor * effort.by_rate.transpose();
      }
    }
  }
  if (!filters()) return;
  const int at = filter_row();
  if (tangent.wants_K) {
    auto K = tangent.K.dense();
    K.row(at) -= error.by_position.transpose() / gains_.filter;
    K(at, at) += 1 / gains_.filter;
  }
  if (tangent.wants_C) {
    auto C = tangent.C.dense();
    C.row(at) -= error.by_rate.transpose() / gains_.filter;
    C(at, at) += 1;
  }
}

void PidDrive::add_start_values(const LocalState& state, Eigen::Ref<VectorX> change) const {
  const bool statics = state.environment().statics;
  const double error = loop(state).error;
  if (filters() && (statics || state.memory()[own_memory()] == 0))
    change[filter_row()] += error - state.first_order()[filter_row()];
  if (!statics || !integrates() || keeps_integral(state)) return;
  // The search starts between the limits: at a limit the effort does not depend on the position.
  const double u = gains_.proportional * error + gains_.integral * state.first_order()[0], side = this->side(u);
  if (side == 0) return;
  const bool both = limit().has_lower() && limit().has_upper();
  const double within = both ? 0.5 * (limit().lower + limit().upper) : 2 * limited(side, u) - u;
  change[0] += (within - u) / gains_.integral;
}

void PidDrive::accept(const LocalState& /*state*/, Eigen::Ref<VectorX> memory) const {
  if (filters()) memory[own_memory()] = 1;
}

std::vector<TimeDependent::Formula> PidDrive::time_formulas() const {
  if (!target_.holds_time()) return {};
  return {{"target", measure_ ? measure_->units() : coordinate().units()}};
}

void PidDrive::calc_time_formulas(const LocalState& state, std::span<double> values) const {
  const double t = state.time();
  values[0] = released(state) ? 0 : target_.value(state, {&t, 1});
}

Drive::LawText PidDrive::law_text() const {
  const bool turning = coordinate().kind != JointCoordinate::Kind::displacement;
  std::string law = fmt::format("PID of {} - {}: kp {:.6g}, ki {:.6g}, kd {:.6g}", target_.text(),
                                measure_ ? measure_->name() : coordinate().name, gains_.proportional, gains_.integral,
                                gains_.derivative);
  if (filters()) law += fmt::format(", filter {:.6g} s", gains_.filter);
  if (integrates() && limit().limits()) law += fmt::format(", tracking time {:.6g} s", tracking_time_);
  return {fmt::format("{} on {}", turning ? "torque" : "force", coordinate().name), law + limit_text(),
          coordinate().force_units()};
}

}  // namespace bielle::mechanism
