#include "mechanism/solvers/statics/stability_watch.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {

StabilityWatch::StabilityWatch(const LoadRamp& ramp, Equilibrium& equilibrium, double branch)
    : ramp_(ramp), equilibrium_(equilibrium), stability_(ramp.system()), branch_(branch) {}

void StabilityWatch::begin(double factor, const State& state) { remember(factor, state, count(factor, state)); }

std::optional<int> StabilityWatch::count(double factor, const State& state) {
  return stability_.count(state, ramp_.environment(factor));
}

void StabilityWatch::remember(double factor, const State& state, const std::optional<int>& count) {
  last_ = state;
  last_factor_ = factor;
  last_count_ = count;
}

void StabilityWatch::look(double factor, State& state, StaticsLog& log) {
  std::optional<int> now = count(factor, state);
  if (branch_ > 0 && !now)
    throw ComputationError(
        "statics: `branch` needs to know the stability of equilibria, which is not a question of stiffness here: it is "
        "not symmetric (forces that follow, moments about fixed axes, friction), or depends on controllers or fluids");
  // A large increment may jump onto an unstable equilibrium where small ones stay on a stable path.
  if (last_ && last_count_ && now && *now > *last_count_)
    if (State trial = *last_; lead(factor, trial)) {
      state = trial;
      now = count(factor, state);
    }
  constexpr int most = 20;  // critical points in one increment that are told one by one
  for (int k = 0; k < most && last_ && last_count_ && now && *now != *last_count_; ++k) {
    CriticalPoint point = locate(factor, state, *now);
    if (branch_ > 0 && point.after > point.before && mode_) {
      if (!follow(factor, *mode_, state))
        throw ComputationError(
            fmt::format("statics: at load factor {:.6g} the equilibrium becomes unstable along {}, and no branch was "
                        "found that leaves there: it may lead back to lower loads (`arc_length`), or be farther away "
                        "than `branch`",
                        point.factor, point.motion));
      point.left = true;
      now = count(factor, state);
      log.critical.push_back(point);
      break;
    }
    log.critical.push_back(point);
    // On from just above it.
    if (above_) remember(above_->first, above_->second, point.after);
    if (!above_) break;
  }
  log.unstable = now;
  remember(factor, state, now);
}

/// Between the last equilibrium and this one: by the smallest stiffness, which changes its sign there, kept within the
/// bracket of the counts (regula falsi after Illinois, or halving where it does not help).
CriticalPoint StabilityWatch::locate(double factor, const State& state, int count) {
  constexpr int most = 60;
  constexpr double accurate = 1e-7;
  CriticalPoint point;
  point.before = *last_count_;
  point.after = count;
  const auto stiffness = [&](const State& at, double under) {
    const auto mode = stability_.softest(at, ramp_.environment(under));
    if (mode) mode_ = mode;
    return mode ? mode->stiffness : 0.0;
  };
  State low_state = *last_;
  above_.reset();
  int count_high = count;
  double low = last_factor_, high = factor, k_low = stiffness(low_state, low), k_high = stiffness(state, high);
  k_before_ = k_low;
  k_after_ = k_high;
  const double whole = std::abs(high - low);
  for (int i = 0, side = 0; i < most && std::abs(high - low) > accurate * whole; ++i) {
    const bool signs = k_low * k_high < 0;
    double middle = signs ? (low * k_high - high * k_low) / (k_high - k_low) : 0.5 * (low + high);
    // Close to the ends nothing would be gained.
    const double margin = 0.25 * accurate * (high - low < 0 ? -whole : whole);
    middle = std::clamp(middle, std::min(low + margin, high - margin), std::max(low + margin, high - margin));
    State trial = low_state;
    // Where the equations are singular, or nearly, this is the place.
    std::optional<int> here;
    if (equilibrium_.find(middle, trial) >= 0) here = stability_.count(trial, ramp_.environment(middle));
    if (!here) {
      low = middle;
      break;
    }
    const double k = stiffness(trial, middle);
    const bool before = *here == point.before;
    if (before) {
      low = middle;
      k_low = k;
      low_state = trial;
    } else {
      high = middle;
      k_high = k;
      count_high = *here;
      above_.emplace(middle, trial);
    }
    if (side == (before ? 1 : -1)) (before ? k_high : k_low) /= 2;
    side = before ? 1 : -1;
  }
  if (std::abs(high - low) <= accurate * whole) point.after = count_high;
  if (point.after == count) above_.reset();
  stiffness(low_state, low);
  point.factor = low;
  point.motion = mode_ ? stability_.describe(*mode_) : "an unknown";
  return point;
}

/// From the last equilibrium with a force along the critical motion that deflects it by `branch`, in steps that keep it
/// stable; then without the force.
bool StabilityWatch::follow(double factor, const Stability::Mode& mode, State& state) {
  constexpr int weakest_first = 4;  // forces that are tried, each four times the one before
  const double stiffness = std::max(std::abs(k_before_), std::abs(k_after_));
  bool found = false;
  for (double part = branch_; part <= branch_ * std::pow(4, weakest_first) && !found; part *= 4) {
    State trial = *last_;
    equilibrium_.push(part * stiffness * mode.force);
    found = lead(factor, trial);
    equilibrium_.push({});
    found = found && equilibrium_.find(factor, trial) >= 0 && is_stable(trial, factor);
    if (found) state = trial;
  }
  return found;
}

bool StabilityWatch::is_stable(const State& state, double factor) {
  const std::optional<int> now = count(factor, state);
  return now && *now <= *last_count_;
}

bool StabilityWatch::lead(double factor, State& state) {
  double at = last_factor_, step = (factor - at) / 4;
  const double least = std::abs(step) / 1024;
  if (equilibrium_.find(at, state) < 0) return false;
  while (at != factor) {
    const double next = std::abs(factor - at) <= std::abs(step) * 1.001 ? factor : at + step;
    State trial = state;
    if (equilibrium_.find(next, trial) < 0 || !is_stable(trial, next)) {
      step /= 2;
      if (std::abs(step) < least) return false;
      continue;
    }
    state = trial;
    at = next;
    step *= 1.5;
  }
  return true;
}

}  // namespace bielle::mechanism
