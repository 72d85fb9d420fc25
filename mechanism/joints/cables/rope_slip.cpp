#include "mechanism/joints/cables/rope_slip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace bielle::mechanism {
namespace {

/// Smaller changes of slip in a step are errors of Newton's method, relative to the length: the rope sticks, and they
/// do not add up.
constexpr double negligible_slip = 1e-10;

/// At the start of a motion a rope that slips has a rate, which follows from its damping: it is the slip over this
/// short time [s].
constexpr double start_time = 1e-9;

}  // namespace

RopeSlip::RopeSlip(std::string type, std::string name, std::string pulley, double length, bool damped)
    : Component(std::move(type), std::move(name)), pulley_(std::move(pulley)), length_(length), damped_(damped) {}

void RopeSlip::declare(Declaration& declaration) const {
  Declaration::Scalar slip{fmt::format("slip on pulley '{}'", pulley_), "m"};
  constexpr double typical_strain = 1e-3;
  slip.scale = typical_strain * length_;
  slip.equation_units = "N";
  slip.algebraic = true;
  declaration.first_order = {std::move(slip)};
  declaration.memory.assign(memories, 0.0);
  declaration.memory[time_memory] = std::numeric_limits<double>::quiet_NaN();
  if (damped_) declaration.memory[step_memory] = start_time;
}

double RopeSlip::passed(const LocalState& own) {
  constexpr double just_after = 1e-6, shortest = 1e-12;  // share of the last step; a time [s]
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  const double passed = own.time() - own.memory()[time_memory];
  const double negligible =
      std::max({just_after * own.memory()[step_memory], rounding * std::abs(own.time()), shortest});
  return std::abs(passed) <= negligible ? 0 : passed;
}

bool RopeSlip::may_change(const LocalState& own) {
  return own.environment().statics || !has_begun(own) || passed(own) > 0;
}

RopeSlip::Rate RopeSlip::mean_rate(const LocalState& own) {
  if (own.environment().statics) return {};
  if (!has_begun(own)) {
    const double start_step = own.memory()[step_memory];
    return start_step > 0 ? Rate{increment(own) / start_step, 1 / start_step} : Rate{};
  }
  const double step = passed(own);
  if (!(step > 0)) return {own.memory()[mean_memory], 0};
  return {increment(own) / step, 1 / step};
}

/// Returns the rate at the end of a step: the mean rates belong to the middles of the steps. It does not change the
/// direction of the slip.
double RopeSlip::rate_at_end(const LocalState& own, double mean, double step) {
  const double before = own.memory()[mean_memory], step_before = own.memory()[step_memory];
  const double rate = mean + (mean - before) * step / (step + step_before);
  return rate * mean > 0 ? rate : 0;
}

double RopeSlip::rate(const LocalState& own) {
  if (own.environment().statics || !has_begun(own)) return 0;
  const double step = passed(own);
  if (!(step > 0)) return own.memory()[rate_memory];
  return rate_at_end(own, increment(own) / step, step);
}

void RopeSlip::accept(const LocalState& state, Eigen::Ref<VectorX> memory) const {
  const bool slips = std::abs(increment(state)) > negligible_slip * length_;
  const bool in_statics = state.environment().statics, starts = !has_begun(state);
  const double step = in_statics || starts ? 0 : passed(state);
  if (slips) memory[slip_memory] = slip(state);
  memory[time_memory] = state.time();
  if (in_statics) memory[mean_memory] = memory[rate_memory] = 0;
  if (starts && !in_statics) memory[mean_memory] = memory[rate_memory] = mean_rate(state).value;
  if (!(step > 0)) return;
  const double mean = slips ? increment(state) / step : 0;
  memory[mean_memory] = mean;
  memory[step_memory] = step;
  memory[rate_memory] = mean == 0 ? 0 : rate_at_end(state, mean, step);
}

/// The time of a state may have been set anew.
void RopeSlip::begin_motion(const LocalState& state, bool /*known*/, Eigen::Ref<VectorX> memory) const {
  if (!std::isnan(memory[time_memory])) memory[time_memory] = state.time();
}

}  // namespace bielle::mechanism
