// Watches the stability of equilibria along load steps: finds where it changes, and the branch that leaves there.
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

  /// The state that the analysis begins with.
  void begin(double factor, const State& state);
  /// An equilibrium is about to be accepted. If stability has changed since the last one, finds where; puts the state
  /// onto the branch, if one is to be followed. @throws ComputationError when there is none to be found
  void look(double factor, State& state, StaticsLog& log);
  /// Whether an equilibrium is unstable along more motions than the last one; false where that is not known.
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
  bool is_stable(const State& state, double factor);  ///< as the last equilibrium was

  const LoadRamp& ramp_;
  Equilibrium& equilibrium_;
  Stability stability_;
  double branch_;
  std::optional<State> last_;  ///< the last equilibrium
  double last_factor_ = 0;
  std::optional<int> last_count_;
  std::optional<std::pair<double, State>> above_;  ///< an equilibrium just above what `locate` found last
  std::optional<Stability::Mode> mode_;            ///< the critical one that was found last
  double k_before_ = 0, k_after_ = 0;              ///< smallest stiffness on either side of it
};

}  // namespace bielle::mechanism
