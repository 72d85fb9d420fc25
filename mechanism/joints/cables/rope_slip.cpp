#include "mechanism/joints/cables/rope_slip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

/// Changes of slip in a step below this fraction of the length are errors of Newton's method. The rope then sticks, and
/// such changes do not accumulate.
constexpr double negligible_slip = 1e-10;

}  // namespace

RopeSlip::RopeSlip(std::string type, std::string name, std::string pulley, double length, double damping)
    : Component(std::move(type), std::move(name)), pulley_(std::move(pulley)), length_(length), damping_(damping) {}

void RopeSlip::declare(Declaration& declaration) const {
  constexpr double typical_strain = 1e-3;
  Declaration::Scalar slip{fmt::format("slip on pulley '{}'", pulley_), "m"};
  slip.scale = typical_strain * length_;
  slip.equation_units = "N";
  slip.algebraic = true;
  declaration.first_order = {slip};
  declaration.memory.assign(memories, 0.0);
  declaration.memory[time_memory] = std::numeric_limits<double>::quiet_NaN();
  declaration.memory[phase_memory] = damping_ > 0 ? begins : first_step;
  if (damping_ == 0) return;
  Declaration::Scalar rate{fmt::format("rate of slip on pulley '{}'", pulley_), "m/s"};
  rate.scale = typical_strain * length_ / damping_;
  rate.equation_units = "N";
  rate.algebraic = true;
  declaration.first_order.push_back(rate);
}

double RopeSlip::passed(const LocalState& own) {
  constexpr double just_after = 2e-6, shortest = 1e-12;  // fraction of the last step; time [s]
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  const double passed = own.time() - own.memory()[time_memory];
  const double negligible =
      std::max({just_after * own.memory()[step_memory], rounding * std::abs(own.time()), shortest});
  return std::abs(passed) <= negligible ? 0 : passed;
}

bool RopeSlip::rate_begins(const LocalState& own) {
  return own.memory()[phase_memory] == begins && !own.environment().statics && !(has_begun(own) && passed(own) > 0);
}

RopeSlip::Change RopeSlip::change(const LocalState& own) {
  return rate_begins(own) ? Change{1, rate_unknown(own)} : Change{0, increment(own)};
}

double RopeSlip::last_change(const LocalState& own) {
  return may_change(own) ? change(own).value : own.memory()[mean_memory] * own.memory()[step_memory];
}

bool RopeSlip::may_change(const LocalState& own) {
  return own.environment().statics || !has_begun(own) || passed(own) > 0 || rate_begins(own);
}

double RopeSlip::per_time(const LocalState& own) {
  if (own.environment().statics || !has_begun(own)) return 0;
  const double step = passed(own);
  return step > 0 ? 1 / step : 0;
}

RopeSlip::Value RopeSlip::rate(const LocalState& own) {
  if (own.environment().statics) return {};
  if (rate_begins(own)) return {rate_unknown(own), 1, 1};
  const double per_time = RopeSlip::per_time(own);
  if (per_time == 0) return {own.memory()[rate_memory], 0, 0};
  const double mean = increment(own) * per_time, before = own.memory()[mean_memory];
  if (own.memory()[phase_memory] != smooth) return {mean, per_time, per_time};
  const double share = 1 / (1 + own.memory()[step_memory] * per_time), most = (1 + share) * per_time;
  if (mean * before < 0) return {mean, per_time, most};
  const double rate = mean + (mean - before) * share;
  return rate * mean > 0 ? Value{rate, most, most} : Value{0, 0, most};
}

void RopeSlip::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  memory[time_memory] = state.time();
  if (rate_begins(state)) return;
  const bool slips = std::abs(increment(state)) > negligible_slip * length_;
  const double per_time = this->per_time(state), end_rate = rate(state).value;
  if (slips) memory[slip_memory] = slip(state);
  if (state.environment().statics) {
    memory[mean_memory] = memory[rate_memory] = 0;
    memory[phase_memory] = first_step;
    return;
  }
  // A step that is much shorter than the last one tells nothing about the rate if its slip is negligible.
  constexpr double short_step = 1e-3;
  if (per_time == 0 || (!slips && 1 / per_time < short_step * memory[step_memory])) return;
  memory[mean_memory] = slips ? increment(state) * per_time : 0;
  memory[rate_memory] = slips ? end_rate : 0;
  memory[step_memory] = 1 / per_time;
  memory[phase_memory] = smooth;
}

/// Restarts the clock of the slip, because the time and the rates of the state may have been changed before the motion.
void RopeSlip::begin_motion(const LocalState& state, bool /*known*/, Eigen::Ref<VectorX> memory) const {
  if (has_begun(state)) memory[time_memory] = state.time();
  memory[phase_memory] = damping_ > 0 ? begins : first_step;
}

void RopeSlip::begin_branch(const LocalState& state, std::span<const int> /*crossed*/,
                            Eigen::Ref<VectorX> memory) const {
  if (!std::isnan(memory[time_memory])) memory[time_memory] = state.time();
  memory[phase_memory] = damping_ > 0 ? begins : first_step;
}

/// An activated rope slips at once, unless it has damping, because its tensions may differ by more than its friction.
void RopeSlip::activate(const LocalState& /*state*/, Eigen::Ref<VectorX> memory) const {
  memory[time_memory] = std::numeric_limits<double>::quiet_NaN();
  memory[mean_memory] = memory[step_memory] = memory[rate_memory] = 0;
}

bool RopeSlip::knows_memory(const LocalState& state) const {
  const double phase = state.memory()[phase_memory];
  return phase == smooth || phase == first_step || phase == begins;
}

}  // namespace bielle::mechanism
