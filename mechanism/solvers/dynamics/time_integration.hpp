// Time integration of a mechanism: steps of generalised-alpha that are tried and accepted, discontinuities, restarts.
//
// What a step is made of has files of its own: the scheme's values (scheme_step), where Newton's method starts
// (extrapolation), the equations with their form of constraints (step_equations, stabilised_equations), Newton's method
// (step_newton), velocities across constraints (velocity_correction), start values (start_values).
//
// The scheme is of second order in positions and velocities, and with its start values in multipliers and accelerations
// as well, across changes of the step too.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanism/solvers/dynamics/extrapolation.hpp"
#include "mechanism/solvers/dynamics/scheme_loss.hpp"
#include "mechanism/solvers/dynamics/short_span.hpp"
#include "mechanism/solvers/dynamics/step_newton.hpp"
#include "mechanism/solvers/dynamics/velocity_correction.hpp"
#include "mechanism/solvers/start/start_report.hpp"

namespace bielle::mechanism {

/// A discontinuity of a motion, from its left to its right.
struct Jump {
  double time = 0;
  Energy before, after;
  double work = 0;  ///< of the drives and supports whose rate jumps [J]
  std::vector<int> crossed;
};

class TimeIntegration {
 public:
  /// @param state  positions and velocities to start from; made consistent here
  TimeIntegration(const System& system, const Environment& environment, const Scheme& scheme, State state,
                  ConstraintForm form = ConstraintForm::corrected, const NewtonOptions& options = {});

  /// Continues a motion from where `exchange` left it.
  TimeIntegration(const System& system, const Environment& environment, const Scheme& scheme, Archive& archive,
                  ConstraintForm form = ConstraintForm::corrected, const NewtonOptions& options = {});
  TimeIntegration(const TimeIntegration&) = delete;
  TimeIntegration& operator=(const TimeIntegration&) = delete;
  /// All that the motion goes on from. What comes after does not depend on whether it was interrupted here: pivots of
  /// the tangent are chosen anew in both cases.
  void exchange(Archive& archive);

  /// Sets the algorithmic start values for steps of size h. Call once before the first step.
  void start(double h);
  /// Tries a step. The motion stays where it is until `accept`; what went wrong is in the report.
  /// @param end   the time at its end: state().time + h but for rounding [s]
  /// @param kink  forces may jump at the end: the step sees those of just before
  StepReport attempt(double h, double end, bool kink = false);
  /// The same over a span that is too short for the scheme (short_span.hpp). If it is accepted as such (`is_short`),
  /// a `restart` has to follow before the next step, unless a `begin_branch` does.
  /// @param small  whether it is shorter than any time constant that matters
  StepReport attempt_short(double h, double end, bool kink, bool small);
  /// An attempt whose accelerations and multipliers are solved for at its end, of a step that is much shorter than
  /// those before (short_span.hpp). A `restart` or a `begin_branch` has to follow where it `is_short`, as above.
  StepReport attempt_settled(double h, double end, bool kink);
  /// Whether the last attempt was over a short span and owes nothing to the scheme.
  bool is_short() const { return short_; }
  /// Spans shorter than this leave accelerations of the scheme less than six digits, at the present state [s].
  double longest_short_span() const { return short_span_.longest(state(), step_.scheme()); }
  StepReport attempt(double h) { return attempt(h, state().time + h); }
  /// Makes the attempted step the motion's last. @throws ComputationError when a constraint that was set aside as
  /// redundant contradicts the others
  /// @returns whether a component has left the branch that the step was computed on: `begin_branch` is wanted
  bool accept();
  /// Both, for a step that has to succeed. @throws ComputationError naming time and equation
  StepReport step(double h);

  /// Changes what a component remembers, from here on.
  void set_memory(int place, double value) { step_.state().memory[place] = value; }

  /// The next attempts will be of size h: renews the algorithmic values that belong to a step size.
  void change_step(double h);
  /// Algorithmic values for steps of size h anew, from velocities, accelerations and multipliers that are consistent.
  void restart(double h);
  /// Forces or constraints have changed at this time: components begin another branch, and velocities, accelerations
  /// and multipliers are those of just after. What comes into force on relative motion stops it by an inelastic
  /// impulse, the least change of velocities in the kinetic energy's norm. Several may follow each other at one time;
  /// after the last comes `start_branch`.
  /// @param crossed  the crossings that were met, by number
  Jump begin_branch(double h, const std::vector<int>& crossed);
  /// Algorithmic values for steps of size h on the branch that has begun. What they change of the energy, of second
  /// order in h, is an error of the steps and no part of the jump. @param time  of the jump
  void start_branch(double h, double time);
  /// The end of the last attempt.
  const State& attempted() const { return step_.trial(); }
  /// While a crossing is located, attempts differ little in size: factors of the tangent serve them all.
  void share_factors(bool shared) { newton_.share_factors(shared); }

  const System& system() const { return system_; }
  const Environment& environment() const { return environment_; }
  const State& state() const { return step_.state(); }
  const State& previous() const { return step_.trial(); }  ///< before the last accepted step
  /// Between the previous and the last accepted step, to the order of the scheme.
  /// @param time  within the last step [s]
  State interpolated(double time) const { return step_.interpolated(time); }
  /// Local error of the attempted step: of the dofs (dofs), exact minus computed.
  VectorX position_error() const { return step_.position_error(); }
  /// The same of the first-order unknowns (first_orders); zero where it is not known: in the first step, and in the
  /// first after a jump of forces.
  VectorX first_order_error() const { return step_.first_order_error(); }
  bool first_order_error_known() const {
    return step_.rates().Y_rate_known || system_.first_orders() == static_cast<int>(system_.algebraic().size());
  }
  /// What the user should know of the last accepted step, whose joints turn far: a sentence, or nothing.
  std::string caution() { return correction_.caution(step_); }
  /// Energy that the scheme's own damping has taken out since the start [J]. Zero for one without (rho = 1, Newmark).
  double scheme_loss() const { return loss_.total(); }
  const StartReport& start_report() const { return start_report_; }

 private:
  void start_anew(double h, StartReport& report);
  void make_consistent_anew(StartReport& report);
  void extrapolate_from_here();
  double begin_trial(double h, double end, int order, StepReport& report);
  void choose_start(double h, double end, StepReport& report);
  StepReport attempt_plainly(double h, double trial_end);
  StepReport attempt_again(const StepReport& before, double h, double end);
  bool accept_short();
  StepReport attempt_from(double h, double end, bool extrapolated);

  const System& system_;
  Environment environment_;
  SchemeStep step_;
  VelocityCorrection correction_;
  StepNewton newton_;
  CrossingValues crossing_values_;
  Extrapolation extrapolation_;
  SchemeLoss loss_;
  ShortSpan short_span_;
  VectorX highest_;  ///< a buffer: SchemeStep::get_highest
  StartReport start_report_;
  double end_ = 0;      ///< of the last attempt [s]
  bool short_ = false;  ///< whether it was over a short span
};

}  // namespace bielle::mechanism
