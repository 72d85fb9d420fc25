#include "mechanism/solvers/statics/stability_watch.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/statics/root_bracket.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {

StabilityWatch::StabilityWatch(const LoadRamp& ramp, Equilibrium& equilibrium, double branch)
    : ramp_(ramp), equilibrium_(equilibrium), stability_(ramp.system(), equilibrium.held()), branch_(branch) {}

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
  // A large increment may jump to an unstable equilibrium while small ones stay on a stable path.
  if (last_ && last_count_ && now && *now > *last_count_)
    if (State trial = *last_; lead(factor, trial)) {
      state = trial;
      now = count(factor, state);
    }
  constexpr int most = 20;  // largest number of critical points in one increment that are listed
  for (int k = 0; k < most && last_ && last_count_ && now && *now != *last_count_; ++k) {
    CriticalPoint point = locate(factor, state, *now);
    if (branch_ > 0 && point.after > point.before && mode_) {
      if (!follow(factor, *mode_, state))
        throw ComputationError(fmt::format(
            "statics: at load factor {:.6g} the equilibrium becomes unstable along {}{}, and no branch was "
            "found that leaves there: it may lead back to lower loads (the mechanism snaps), or be farther "
            "away than `branch`",
            point.factor, point.after - point.before > 1 ? "several motions at once, most along " : "", point.motion));
      point.left = true;
      now = count(factor, state);
      log.critical.push_back(point);
      break;
    }
    log.critical.push_back(point);
    if (!above_) break;
    remember(above_->first, above_->second, point.after);  // continues from just above it
  }
  log.unstable = now;
  log.why_not_known = now ? "" : stability_.why_not_known();
  remember(factor, state, now);
}

/// Locates the point between the last equilibrium and this one at which the number changes, by the zero of the smallest
/// stiffness within the bracket of the counts.
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
  State below = *last_;
  above_.reset();
  int count_above = count;
  k_before_ = stiffness(below, last_factor_);
  k_after_ = stiffness(state, factor);
  RootBracket bracket(last_factor_, k_before_, factor, k_after_);
  const double whole = bracket.width();
  std::optional<double> singular;
  for (int i = 0; i < most && bracket.width() > accurate * whole; ++i) {
    const double middle = bracket.next(0.25 * accurate * whole);
    State trial = below;
    std::optional<int> here;
    if (equilibrium_.find(middle, trial) >= 0) here = this->count(middle, trial);
    // If the equations are singular, or nearly, the point is found.
    if (!here) {
      singular = middle;
      break;
    }
    const bool before = *here == point.before;
    bracket.replace(before, middle, stiffness(trial, middle));
    if (before) {
      below = trial;
    } else {
      count_above = *here;
      above_.emplace(middle, trial);
    }
  }
  point.factor = singular.value_or(bracket.low());
  const double left = singular ? bracket.width() - std::abs(*singular - bracket.low()) : bracket.width();
  if (left <= accurate * whole) point.after = count_above;
  if (point.after == count) above_.reset();
  stiffness(below, point.factor);
  point.motion = mode_ ? stability_.describe(*mode_) : "an unknown";
  return point;
}

/// Follows the branch from the last equilibrium with a force along the critical motion that deflects it by `branch`, in
/// steps that keep it stable; then without the force.
bool StabilityWatch::follow(double factor, const Stability::Mode& mode, State& state) {
  constexpr double strongest = 256;  // relative to the first force that is tried; each is four times the previous one
  const double stiffness = std::max(std::abs(k_before_), std::abs(k_after_));
  for (double times = 1; times <= strongest; times *= 4) {
    State trial = *last_;
    equilibrium_.push(times * branch_ * stiffness * mode.force);
    const bool led = lead(factor, trial);
    equilibrium_.push({});
    if (led) hold_neutral(factor, trial);
    if (!led || equilibrium_.find(factor, trial) < 0 || !is_stable(trial, factor)) continue;
    state = trial;
    return true;
  }
  return false;
}

/// A branch that begins along two motions at once may belong to a circle of branches, along which there is no stiffness
/// (a round rod may buckle to any side). Such a motion is held like an indifferent one.
void StabilityWatch::hold_neutral(double factor, const State& state) {
  equilibrium_.look_for_loose(factor, state);
  if (equilibrium_.held()) stability_.hold(*equilibrium_.held());
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
