#include "mechanism/solvers/statics/statics.hpp"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/statics/equilibrium.hpp"
#include "mechanism/solvers/statics/held_coordinates.hpp"
#include "mechanism/solvers/statics/held_states.hpp"
#include "mechanism/solvers/statics/increments.hpp"
#include "mechanism/solvers/statics/overloaded_friction.hpp"
#include "mechanism/solvers/statics/path_watch.hpp"
#include "mechanism/solvers/statics/stability.hpp"
#include "mechanism/solvers/statics/stability_watch.hpp"
#include "mechanism/solvers/statics/static_tangent.hpp"

namespace bielle::mechanism {

namespace {

/// A static analysis by load steps.
class LoadStepping {
 public:
  LoadStepping(const LoadRamp& ramp, const Environment& environment, const LoadSteps& steps,
               const NewtonOptions& options, State& state)
      : ramp_(ramp),
        steps_(steps),
        line_search_(options.line_search),
        state_(state),
        begin_(ramp.begin()),
        loaded_(begin_ == 1),
        increments_(loaded_ ? 1 : steps.count, parts_of_the_way(steps.stops, begin_)),
        held_(ramp.system(), environment, state, steps.held),
        equilibrium_(ramp, options, held_.any() ? &held_ : nullptr),
        watch_(ramp, ready(equilibrium_, state), steps.branch),
        path_(ramp, equilibrium_, state) {
    if (!loaded_) watch_.begin(begin_, state_);
  }

  bool ended() const { return increments_.ended(); }
  /// Makes an increment, or reduces the next one. @returns the number of iterations, or -1 if it was rejected
  int advance();
  double factor() const { return factor_at(increments_.made()); }
  StaticsLog log() {
    log_.solves = equilibrium_.solves();
    return log_;
  }

 private:
  Equilibrium& ready(Equilibrium& equilibrium, const State& state) const {
    equilibrium.look_for_loose(factor_at(increments_.end()), state);
    return equilibrium;
  }
  double factor_at(double part) const;
  int find(double factor, bool& falls);
  void refuse(double factor, bool falls);
  int follow(double factor);
  bool judge(const PathWatch::Point& from, double factor);
  void land(PathWatch::Point& to, const PathWatch::Verdict& verdict, LoadJump& jump);

  const LoadRamp& ramp_;
  const LoadSteps& steps_;
  bool line_search_;
  State& state_;
  double begin_;
  bool loaded_;  ///< whether all of the load acts already
  Increments increments_;
  HeldCoordinates held_;
  Equilibrium equilibrium_;
  StabilityWatch watch_;
  PathWatch path_;
  StaticsLog log_;
  std::string why_;  ///< reason if no equilibrium was found
};

double LoadStepping::factor_at(double part) const {
  if (part == 1) return 1.0;
  const double factor = begin_ + part * (1 - begin_);
  for (const double stop : steps_.stops)  // exactly equal
    if (std::abs(stop - factor) <= 1e-12) return stop;
  return factor;
}

int LoadStepping::advance() {
  const double factor = factor_at(increments_.end());
  const PathWatch::Point before{this->factor(), state_};
  bool falls = false, followed = false;
  const long solves = equilibrium_.solves();
  int iterations = find(factor, falls);
  if (iterations < 0) {
    refuse(factor, falls);
    return -1;
  }
  if (falls) log_.fell = why_;
  if (!loaded_ && !falls && !held_.any()) {  // held coordinates have another path
    followed = judge(before, factor);
    if (followed) iterations = static_cast<int>(equilibrium_.solves() - solves);
  }
  watch_.look(factor, state_, log_);
  equilibrium_.accept(factor, state_);
  increments_.accept(iterations, followed);
  return iterations;
}

/// @param falls  set if a part has been released
int LoadStepping::find(double factor, bool& falls) {
  int iterations = equilibrium_.find(factor, state_);
  falls = equilibrium_.falls();
  if (iterations < 0) why_ = equilibrium_.why();
  const bool last_means = !falls && (loaded_ || increments_.stuck());
  if (iterations < 0 && last_means && line_search_) {
    iterations = equilibrium_.search(factor, state_);
    why_ = equilibrium_.why();
  }
  if (iterations < 0 && last_means && !loaded_) iterations = follow(factor);
  if (iterations < 0 && (loaded_ || falls)) {
    iterations = equilibrium_.relax(factor, state_);
    if (!falls) why_ = equilibrium_.why();
  }
  return iterations;
}

/// Applies the last method if Newton's method does not converge. @returns the number of iterations, or -1
int LoadStepping::follow(double factor) {
  const long solves = equilibrium_.solves();
  PathWatch::Point point{this->factor(), state_};
  if (!path_.follow(point, factor)) return -1;
  state_ = point.state;
  return static_cast<int>(equilibrium_.solves() - solves);
}

void LoadStepping::refuse(double factor, bool falls) {
  ++log_.refused;
  log_.refused_at = factor;
  log_.why_refused = why_;
  const double size = (increments_.end() - increments_.made()) * (1 - begin_);
  if (!loaded_ && !falls && increments_.halve()) return;
  std::string advice = describe_overloaded_friction(ramp_, equilibrium_, factor, state_);
  if (advice.empty() && !loaded_ && !falls)
    advice = "; if the load has a maximum there, `arc_length` follows the path past it";
  throw ComputationError(fmt::format("statics: no equilibrium found at load factor {:.6g} (increment {:.3g}): {}{}",
                                     factor, size, why_, advice));
}

/// Moves a new increment to its path, and records jumps. @returns whether the path had to be followed
bool LoadStepping::judge(const PathWatch::Point& from, double factor) {
  PathWatch::Point to{factor, state_};
  const PathWatch::Verdict verdict = path_.look(from, to);
  if (verdict.jump) {
    LoadJump jump = *verdict.jump;
    const PathWatch::Point found = to;
    land(to, verdict, jump);
    log_.jumps.push_back(jump);
    // Stability is monitored along paths, not across jumps.
    const bool same = path_.jump_between(found, to).distance == 0;
    const PathWatch::Point& landing = verdict.landing && same ? *verdict.landing : to;
    watch_.begin(landing.factor, landing.state);
  }
  state_ = to.state;
  return verdict.followed;
}

/// Moves the mechanism to its rest position from the start of a jump that led to an unstable equilibrium.
void LoadStepping::land(PathWatch::Point& to, const PathWatch::Verdict& verdict, LoadJump& jump) {
  if (!watch_.less_stable(to.factor, to.state) && !verdict.sign_changed) return;
  PathWatch::Point down{to.factor, verdict.below->state};
  if (equilibrium_.relax(to.factor, down.state) < 0 || watch_.less_stable(down.factor, down.state)) return;
  jump = path_.jump_between(*verdict.below, down);
  to = down;
}

}  // namespace

StaticsLog solve_statics(const System& system, const Environment& environment, const LoadSteps& steps,
                         const NewtonOptions& options, State& state,
                         const std::function<void(const State&, double, int)>& record) {
  const LoadRamp ramp(system, environment, steps.start);
  ramp.set_off(state);
  begin_states(system, ramp.environment(1), state);
  LoadStepping stepping(ramp, environment, steps, options, state);
  while (!stepping.ended()) {
    const int iterations = stepping.advance();
    if (iterations >= 0 && record) record(state, stepping.factor(), iterations);
  }
  return stepping.log();
}

namespace {

void note_stability(const System& system, const Environment& environment, const State& state, StartReport& report) {
  StaticTangent tangent(system);
  tangent.look_for_loose(state, environment);  // an unsupported motion is indifferent: its sign is rounding
  Stability stability(system, tangent.held());
  report.unstable = stability.count(state, environment).value_or(0);
  if (report.unstable > 0)
    if (const auto mode = stability.softest(state, environment)) report.unstable_motion = stability.describe(*mode);
}

void relax(const System& system, const Environment& environment, const NewtonOptions& options,
           const std::vector<CoordinateCondition>& held, State& state) {
  const LoadRamp ramp(system, environment, {1, 1});
  ramp.set_off(state);
  begin_states(system, ramp.environment(1), state);
  HeldCoordinates coordinates(system, environment, state, held);
  Equilibrium equilibrium(ramp, options, coordinates.any() ? &coordinates : nullptr);
  if (equilibrium.relax(1, state) < 0)
    throw ComputationError(fmt::format(
        "static equilibrium at the start: none was found (what nothing holds has none); {}", equilibrium.why()));
  equilibrium.accept(1, state);
}

}  // namespace

void settle(const System& system, const Environment& of_motion, const NewtonOptions& options,
            const std::vector<CoordinateCondition>& held, State& state, StartReport& report) {
  Environment environment = of_motion;
  environment.statics = true;
  assemble_positions(system, environment, state, report);
  VectorX v(system.dofs()), unused(system.dofs());
  system.get_rates(state, v, unused);
  const State assembled = state;
  try {
    LoadSteps steps(1, {0, 1});
    steps.held = held;
    solve_statics(system, environment, steps, options, state);
  } catch (const ComputationError&) {
    state = assembled;
    relax(system, environment, options, held, state);
  }
  // A held coordinate would count as indifferent, or as unstable.
  if (held.empty()) {
    report.loose = loose_unknown(system, environment, state);
    note_stability(system, environment, state, report);
  }
  system.set_rates(state, v, VectorX::Zero(system.dofs()));
  note_farthest(system, assembled, state, report.settled, report.settled_node);
  report.held = held_names(system, state);
}

}  // namespace bielle::mechanism
