#include "mechanism/solvers/statics/statics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/statics/equilibrium.hpp"
#include "mechanism/solvers/statics/held_states.hpp"
#include "mechanism/solvers/statics/jump_watch.hpp"
#include "mechanism/solvers/statics/stability.hpp"
#include "mechanism/solvers/statics/stability_watch.hpp"
#include "mechanism/solvers/statics/static_tangent.hpp"

namespace bielle::mechanism {

namespace {

/// Which part of the way from the first load factor to the full load is gone next.
class Increments {
 public:
  /// @param count  equal parts; 0: chosen by how fast Newton's method converges
  /// @param stops  where one ends in any case, ascending
  Increments(int count, std::vector<double> stops)
      : grid_(count > 0 ? 1.0 / count : 0),
        part_(count > 0 ? grid_ : 0.1),
        least_(part_ / 1024),
        stops_(std::move(stops)) {}

  bool ended() const { return made_ == 1; }
  double made() const { return made_; }
  /// Where the next one ends: at most at the next point of the grid.
  double end() const {
    constexpr double rounding = 1e-9;
    double end = made_ + part_;
    if (grid_ > 0) end = std::min(end, grid_ * (std::floor(made_ / grid_ + rounding) + 1));
    if (end > 1 - rounding) end = 1;
    const auto stop = std::upper_bound(stops_.begin(), stops_.end(), made_);
    return stop != stops_.end() && *stop < end * (1 + rounding) ? *stop : end;
  }
  /// Increments have been halved so often that another way is tried.
  bool stuck() const { return part_ <= 16 * least_; }
  /// @returns false when they have become too small
  bool halve() {
    part_ = (end() - made_) / 2;
    calm_ = 0;
    return part_ >= least_;
  }
  void accept(int iterations) {
    made_ = end();
    ++calm_;
    if (grid_ > 0) {
      if (iterations <= easy || calm_ > 1) part_ = std::min(grid_, 2 * part_);
    } else {
      part_ = std::min(1.0, part_ * std::clamp(static_cast<double>(easy) / std::max(1, iterations), 0.5, 2.0));
    }
  }

 private:
  static constexpr int easy = 6;  // iterations of Newton's method
  double grid_, part_, least_, made_ = 0;
  std::vector<double> stops_;
  int calm_ = 0;  ///< increments since one was refused
};

/// Load factors after the first one, as parts of the way from there to the full load.
std::vector<double> parts_of_the_way(const std::vector<double>& factors, double begin) {
  std::vector<double> parts;
  for (const double factor : factors)
    if (factor > begin && factor <= 1) parts.push_back(factor == 1 ? 1 : (factor - begin) / (1 - begin));
  return parts;
}

}  // namespace

StaticsLog solve_statics(const System& system, const Environment& environment, const LoadSteps& steps,
                         const NewtonOptions& options, State& state,
                         const std::function<void(const State&, double, int)>& record) {
  const LoadRamp ramp(system, environment, steps.start);
  ramp.set_off(state);
  begin_states(system, ramp.environment(1), state);
  Equilibrium equilibrium(ramp, options);
  const double begin = ramp.begin();
  const bool loaded = begin == 1;
  StaticsLog log;
  Increments increments(loaded ? 1 : steps.count, parts_of_the_way(steps.stops, begin));
  const auto factor_at = [&](double part) {
    if (part == 1) return 1.0;
    const double factor = begin + part * (1 - begin);
    for (const double stop : steps.stops)  // to the last bit
      if (std::abs(stop - factor) <= 1e-12) return stop;
    return factor;
  };
  equilibrium.look_for_loose(factor_at(increments.end()), state);
  StabilityWatch watch(ramp, equilibrium, steps.branch);
  JumpWatch jumps(ramp.system(), equilibrium);
  if (!loaded) watch.begin(begin, state);
  while (!increments.ended()) {
    const double end = increments.end(), factor = factor_at(end);
    const State before = state;
    int iterations = equilibrium.find(factor, state);
    const bool falls = equilibrium.falls();
    const std::string why_falls = falls ? equilibrium.why() : "";
    if (iterations < 0 && !falls && options.line_search && (loaded || increments.stuck()))
      iterations = equilibrium.search(factor, state);
    if (iterations < 0 && (loaded || falls)) iterations = equilibrium.relax(factor, state);
    if (iterations < 0) {
      ++log.refused;
      log.refused_at = factor;
      log.why_refused = equilibrium.why();
      if (loaded || falls || !increments.halve())
        throw ComputationError(
            fmt::format("statics: no equilibrium found at load factor {:.6g} (increment {:.3g}): {}{}", factor,
                        (end - increments.made()) * (1 - begin), falls ? why_falls : equilibrium.why(),
                        loaded || falls ? ""
                                        : "; if the load has a maximum there, `arc_length` "
                                          "follows the path past it"));
      continue;
    }
    if (falls) log.fell = why_falls;
    if (!loaded && !falls)
      if (const auto jump = jumps.look({factor_at(increments.made()), before}, {factor, state}))
        log.jumps.push_back(*jump);
    watch.look(factor, state, log);
    equilibrium.accept(factor, state);
    increments.accept(iterations);
    if (record) record(state, factor, iterations);
  }
  log.solves = equilibrium.solves();
  return log;
}

namespace {

void note_stability(const System& system, const Environment& environment, const State& state, StartReport& report) {
  Stability stability(system);
  report.unstable = stability.count(state, environment).value_or(0);
  if (report.unstable > 0)
    if (const auto mode = stability.softest(state, environment)) report.unstable_motion = stability.describe(*mode);
}

void relax(const System& system, const Environment& environment, const NewtonOptions& options, State& state) {
  const LoadRamp ramp(system, environment, {1, 1});
  ramp.set_off(state);
  begin_states(system, ramp.environment(1), state);
  Equilibrium equilibrium(ramp, options);
  if (equilibrium.relax(1, state) < 0)
    throw ComputationError(fmt::format(
        "static equilibrium at the start: none was found (what nothing holds has none); {}", equilibrium.why()));
  equilibrium.accept(1, state);
}

}  // namespace

void settle(const System& system, const Environment& of_motion, const NewtonOptions& options, State& state,
            StartReport& report) {
  Environment environment = of_motion;
  environment.statics = true;
  assemble_positions(system, environment, state, report);
  VectorX v(system.dofs()), unused(system.dofs());
  system.get_rates(state, v, unused);
  const State assembled = state;
  try {
    solve_statics(system, environment, LoadSteps(1, {0, 1}), options, state);
  } catch (const ComputationError&) {
    state = assembled;
    relax(system, environment, options, state);
  }
  report.loose = loose_unknown(system, environment, state);
  note_stability(system, environment, state, report);
  system.set_rates(state, v, VectorX::Zero(system.dofs()));
  note_farthest(system, assembled, state, report.settled, report.settled_node);
  report.held = held_names(system, state);
}

}  // namespace bielle::mechanism
