// Monitors the stability of equilibria along load steps: finds its changes, and the branch at such a point.
#pragma once

#include <optional>
#include <utility>

#include "mechanism/solvers/statics/equilibrium.hpp"
#include "mechanism/solvers/statics/stability.hpp"
#include "mechanism/solvers/statics/statics.hpp"

namespace bielle::mechanism {

class StabilityWatch {
 public:
  /// @param branch  see LoadSteps
  StabilityWatch(const LoadRamp& ramp, Equilibrium& equilibrium, double branch);

  /// Sets the initial state of the analysis.
  void begin(double factor, const State& state);
  /// Checks an equilibrium before it is accepted. If stability has changed since the last one, locates the change;
  /// moves the state to the branch, if one is to be followed. @throws ComputationError if no branch is found
  void look(double factor, State& state, StaticsLog& log);
  /// Returns whether an equilibrium has more unstable motions than the last one; false if that is not known.
  bool less_stable(double factor, const State& state) {
    const std::optional<int> now = count(factor, state);
    return now && last_count_ && *now > *last_count_;
  }

 private:
  std::optional<int> count(double factor, const State& state);
  void remember(double factor, const State& state, const std::optional<int>& count);
  CriticalPoint locate(double factor, const State& state, int count);
  bool follow(double factor, const Stability::Mode& mode, State& state);
  void hold_neutral(double factor, const State& state);
  bool lead(double factor, State& state);
  bool is_stable(const State& state, double factor);  ///< compared with the last equilibrium

  const LoadRamp& ramp_;
  Equilibrium& equilibrium_;
  Stability stability_;
  double branch_;
  std::optional<State> last_;  ///< the last equilibrium
  double last_factor_ = 0;
  std::optional<int> last_count_;
  std::optional<std::pair<double, State>> above_;  ///< an equilibrium just above the point found by `locate`
  std::optional<Stability::Mode> mode_;            ///< the last critical motion
  double k_before_ = 0, k_after_ = 0;              ///< smallest stiffness on both sides of it
};

}  // namespace bielle::mechanism
