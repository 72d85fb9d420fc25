// Newton's method in a step: from a trial that has begun to one in equilibrium.
//
// Factors of the tangent are kept from step to step as long as the residual falls fast enough with them, and as they
// save more than they cost. After the last iteration, what is left of the residual is taken out once more unless it is
// little relative to the tolerance: a tangent that is not of this iterate leaves a residual of the tolerance's size, of
// the same sign step after step.
#pragma once

#include <cmath>
#include <exception>
#include <memory>

#include "mechanism/solvers/constraints/reaction_norm.hpp"
#include "mechanism/solvers/dynamics/step_equations.hpp"
#include "mechanism/solvers/dynamics/step_report.hpp"
#include "mechanism/solvers/newton/balance_search.hpp"
#include "mechanism/solvers/newton/convergence.hpp"

namespace bielle::mechanism {

class StepNewton {
 public:
  StepNewton(const System& system, const Environment& environment, std::unique_ptr<StepEquations> equations,
             const NewtonOptions& options);

  /// A step begins from the accepted state.
  void begin(const State& state);
  /// Evaluates the residual at the trial. @throws ComputationError when a component refuses what it is asked for
  void evaluate(SchemeStep& step, StepReport& report);
  /// Size of the last residual, comparable between trials of the same step.
  double size_of_residual();
  /// Whether there is something to measure residuals by: not before the first factorisation.
  bool measures() const { return measures_; }
  /// Iterates from a trial that has been evaluated. What went wrong is in the report.
  /// @throws ComputationError when a component refuses what it is asked for, or the equations are singular
  void solve(SchemeStep& step, StepReport& report);
  /// What a refusal adds: where the iteration stood before it went astray.
  void explain(SchemeStep& step, StepReport& report);
  /// From here on, and until it is called with false: balances that may be flat (FlowBalance) are searched for at each
  /// iterate. Slower, and the only way where they are.
  /// @returns whether there are any
  bool search_balances(bool wanted);
  /// The next iteration needs a tangent of its own, and measures the rounding of residuals anew: that of a step as
  /// short as an event left it is not that of others.
  void forget_factors() {
    factored_for_ = 0;
    floor_age_ = never_measured;
  }
  /// What comes next owes nothing to what was before: pivots, factors, rounding.
  void begin_anew();
  /// While a crossing is located, steps differ little in size: factors of the tangent serve them all.
  void share_factors(bool shared) { factors_serve_within_ = shared ? 0.1 : same; }
  /// Sizes of steps that differ by rounding are the same.
  static bool same_size(double h, double other, double within = same) { return std::abs(h - other) <= within * other; }

 private:
  static constexpr int never_measured = 1 << 20;
  static constexpr double same = 1e-9;
  void factor(SchemeStep& step, StepReport& report);
  void solve_with_factors(StepReport& report);
  void improve(SchemeStep& step, StepReport& report);
  void shorten(SchemeStep& step, double before, std::exception_ptr refusal, StepReport& report);
  void move_and_follow(SchemeStep& step, double part);
  void polish(SchemeStep& step, StepReport& report);
  void judge_factors(const StepReport& report);
  bool reached(const SchemeStep& step, const StepReport& report);
  bool within_tolerance();
  bool finite(const StepReport& report) const;
  bool beyond_bounds(const State& trial);
  std::string refusal(const SchemeStep& step, const StepReport& report) const;

  const System& system_;
  const Environment& environment_;
  NewtonOptions options_;
  std::unique_ptr<StepEquations> equations_;
  Convergence convergence_;
  ReadReactions reactions_;
  VectorX r_, delta_;
  VectorX r_evaluated_;  ///< an evaluation that fails leaves r_ as it was
  ResidualScale scale_;
  double h_ = 0;                       ///< of the trial that r_ belongs to
  double size_ = 0, size_before_ = 0;  ///< of the residual, now and an iteration before: Convergence::size_of
  bool measures_ = false;
  double factored_for_ = 0;                ///< the step size that the factors belong to; 0: none that serve
  double spent_ = 0;                       ///< iterations since, and what the factors took in iterations
  int served_ = 0;                         ///< steps since
  double factors_serve_within_ = same;     ///< relative difference of sizes that factors serve
  std::unique_ptr<BalanceSearch> search_;  ///< made when it is first wanted
  bool searches_ = false;
  int floor_age_ = never_measured;  ///< steps since the rounding floor was measured
};

}  // namespace bielle::mechanism
