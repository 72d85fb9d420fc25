#include "mechanism/solvers/statics/statics.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/statics/equilibrium.hpp"
#include "mechanism/solvers/statics/held_states.hpp"
#include "mechanism/solvers/statics/stability.hpp"
#include "mechanism/solvers/statics/stability_watch.hpp"

namespace bielle::mechanism {

namespace {

/// Which part of the way from the first load factor to the full load is gone next.
class Increments {
 public:
  /// @param count  equal parts; 0: chosen by how fast Newton's method converges
  explicit Increments(int count)
      : grid_(count > 0 ? 1.0 / count : 0), part_(count > 0 ? grid_ : 0.1), least_(part_ / 1024) {}

  bool ended() const { return made_ == 1; }
  double made() const { return made_; }
  /// Where the next one ends: at most at the next point of the grid.
  double end() const {
    constexpr double rounding = 1e-9;
    double end = made_ + part_;
    if (grid_ > 0) end = std::min(end, grid_ * (std::floor(made_ / grid_ + rounding) + 1));
    return end > 1 - rounding ? 1 : end;
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
  int calm_ = 0;  ///< increments since one was refused
};

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
  StabilityWatch watch(ramp, equilibrium, steps.branch);
  StaticsLog log;
  Increments increments(loaded ? 1 : steps.count);
  if (!loaded) watch.begin(begin, state);
  while (!increments.ended()) {
    const double end = increments.end(), factor = end == 1 ? 1 : begin + end * (1 - begin);
    int iterations = equilibrium.find(factor, state);
    if (iterations < 0 && options.line_search && (loaded || increments.stuck()))
      iterations = equilibrium.search(factor, state);
    if (iterations < 0 && loaded) iterations = equilibrium.relax(factor, state);
    log.solves = equilibrium.solves();
    if (iterations < 0) {
      ++log.refused;
      log.refused_at = factor;
      log.why_refused = equilibrium.why();
      if (loaded || !increments.halve())
        throw ComputationError(fmt::format("statics: no equilibrium found at load factor {:.6g} (increment {:.3g}): {}",
                                           factor, (end - increments.made()) * (1 - begin), equilibrium.why()));
      continue;
    }
    watch.look(factor, state, log);
    log.solves = equilibrium.solves();
    equilibrium.accept(factor, state);
    increments.accept(iterations);
    if (record) record(state, factor, iterations);
  }
  return log;
}

namespace {

/// The unknown that moves most where nothing resists; none where everything resists.
std::optional<int> loose_unknown(const System& system, const Environment& environment, const State& state) {
  LinearStep linear(system);
  TangentWeights weights;
  weights.acceleration_level = true;
  if (!linear.try_factor(state, environment, weights, nullptr)) return linear.singular_unknown();
  if (!linear.nearly_singular()) return {};
  // A solution for any forces lies along what is loose.
  VectorX motion(system.size());
  linear.solve(VectorX::LinSpaced(system.size(), 1, 2), motion);
  Eigen::Index most = 0;
  motion.head(system.dofs()).cwiseAbs().maxCoeff(&most);
  return static_cast<int>(most);
}

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
  if (const auto loose = loose_unknown(system, environment, state))
    throw ComputationError(fmt::format("static equilibrium at the start: it is not unique: {} meets no resistance",
                                       *loose >= 0 ? system.unknown_name(*loose) : "an unknown"));
  note_stability(system, environment, state, report);
  system.set_rates(state, v, VectorX::Zero(system.dofs()));
  note_farthest(system, assembled, state, report.settled, report.settled_node);
  report.held = held_names(system, state);
}

}  // namespace bielle::mechanism
