// Newton's method in a step: from the beginning of a trial to its equilibrium.
//
// Factors of the tangent are reused from step to step as long as they save more than they cost (tangent_policy.hpp).
// After the last iteration, the remaining residual is corrected once more unless it is small relative to the tolerance:
// a tangent of another iterate leaves a residual of the tolerance's size, with the same sign in every step.
#pragma once

#include <cmath>
#include <exception>
#include <memory>

#include "mechanism/solvers/constraints/reaction_norm.hpp"
#include "mechanism/solvers/dynamics/step_equations.hpp"
#include "mechanism/solvers/dynamics/step_report.hpp"
#include "mechanism/solvers/dynamics/tangent_policy.hpp"
#include "mechanism/solvers/newton/balance_search.hpp"
#include "mechanism/solvers/newton/convergence.hpp"

namespace bielle::mechanism {

class StepNewton {
 public:
  StepNewton(const System& system, const Environment& environment, std::unique_ptr<StepEquations> equations,
             const NewtonOptions& options);

  /// Begins a step from the accepted state.
  void begin(const State& state);
  /// Evaluates the residual at the trial. @throws ComputationError if a component cannot be evaluated
  void evaluate(SchemeStep& step, StepReport& report);
  /// Size of the last residual, comparable between trials of the same step.
  double size_of_residual();
  /// Returns whether a scale for residuals is known: not before the first factorisation.
  bool measures() const { return measures_; }
  /// Iterates from a trial that has been evaluated. The report contains the reason of a failure.
  /// @throws ComputationError if a component cannot be evaluated, or the equations are singular
  void solve(SchemeStep& step, StepReport& report);
  /// Adds to the report of a failed step the state of the iteration before it diverged.
  void explain(SchemeStep& step, StepReport& report);
  /// Switches the search for balances that may be constant (FlowBalance) at each iterate on or off. This is slower, but
  /// necessary for such balances.
  /// @returns whether there are any balances
  bool search_balances(bool wanted);
  /// Makes the next iteration compute a new tangent and measure the rounding of residuals again: the rounding in a very
  /// short step after an event differs from that of other steps.
  void forget_factors() {
    factored_for_ = 0;
    floor_age_ = never_measured;
  }
  /// Discards pivots, factors and rounding, so that later results do not depend on earlier ones.
  void begin_anew();
  /// Lets steps of similar sizes share one factorisation of the tangent: sizes differ little while an event is located.
  void share_factors(bool shared) { factors_serve_within_ = shared ? 0.1 : same; }
  /// Returns whether two step sizes are equal up to rounding.
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
  double spent(const StepReport& report) const;
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
  VectorX r_evaluated_;  ///< keeps r_ unchanged if an evaluation fails
  ResidualScale scale_;
  double h_ = 0;                       ///< step size of the trial of r_
  double size_ = 0, size_before_ = 0;  ///< size of the residual, now and one iteration before: Convergence::size_of
  bool measures_ = false;
  double factored_for_ = 0;  ///< step size of the factors; 0: there are no valid ones
  TangentPolicy policy_;
  int evaluations_before_ = 0;             ///< number of evaluations in the step before its first iteration
  double wasted_ = 0;                      ///< cost of the iterations in the step before its first factorisation
  double factors_serve_within_ = same;     ///< relative difference of step sizes for which factors are valid
  std::unique_ptr<BalanceSearch> search_;  ///< created on first use
  bool searches_ = false;
  int floor_age_ = never_measured;  ///< number of steps since the rounding was measured
};

}  // namespace bielle::mechanism
