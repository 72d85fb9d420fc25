// Time integration of a mechanism: attempted and accepted steps of generalised-alpha, discontinuities, restarts.
//
// The parts of a step have their own files: the scheme's values (scheme_step), the initial guess of Newton's method
// (extrapolation), the equations with their form of constraints (step_equations, stabilised_equations), Newton's method
// (step_newton), velocities across constraints (velocity_correction), start values (start_values).
//
// The scheme is of second order in positions and velocities; with its start values also in multipliers and
// accelerations, even if the step size changes.
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
#include "mechanism/system/echoes.hpp"
#include "mechanism/system/sampling.hpp"

namespace bielle::mechanism {

/// A discontinuity of a motion, with the energies just before and just after it.
struct Jump {
  double time = 0;
  Energy before, after;
  double work =
      0;  ///< work of the drives and supports whose rate jumps, and of the errors that the restart removes [J]
  bool prescribed = false;  ///< whether the rate of a drive's or a support's prescribed motion jumps
  std::vector<int> crossed;
};

class TimeIntegration {
 public:
  /// @param state  positions and velocities at the start; they are made consistent
  TimeIntegration(const System& system, const Environment& environment, const Scheme& scheme, State state,
                  ConstraintForm form = ConstraintForm::corrected, const NewtonOptions& options = {});

  /// Continues a motion from the data of `exchange`.
  TimeIntegration(const System& system, const Environment& environment, const Scheme& scheme, Archive& archive,
                  ConstraintForm form = ConstraintForm::corrected, const NewtonOptions& options = {});
  TimeIntegration(const TimeIntegration&) = delete;
  TimeIntegration& operator=(const TimeIntegration&) = delete;
  /// Exchanges all data that the motion continues from. The later motion does not depend on whether it was interrupted
  /// here: pivots of the tangent are chosen again in both cases.
  void exchange(Archive& archive);

  /// Sets the algorithmic start values for steps of size h. It must be called once before the first step.
  void start(double h);
  /// Attempts a step. The motion is unchanged until `accept`; the report contains the reason of a failure.
  /// @param end   the time at its end: state().time + h up to rounding [s]
  /// @param kink  forces may jump at the end: the step uses those just before
  StepReport attempt(double h, double end, bool kink = false);
  /// Attempts a span that is too short for the scheme (short_span.hpp). If it is accepted as such (`is_short`), either
  /// `restart` or `begin_branch` must be called before the next step.
  /// @param small  whether it is shorter than any relevant time constant
  StepReport attempt_short(double h, double end, bool kink, bool small);
  /// Attempts a step that is much shorter than those before, and solves for its accelerations and multipliers at its
  /// end (short_span.hpp). If it `is_short`, `restart` or `begin_branch` must follow, as above.
  StepReport attempt_settled(double h, double end, bool kink);
  /// Returns the first time after `after` at which an earlier jump comes back by a delay [s]; infinity if none does.
  double next_echo(double after) const { return echoes_.next(state(), environment_, after); }
  /// Returns whether the last attempt was over a short span, without the scheme.
  bool is_short() const { return short_; }
  /// In spans shorter than this, accelerations of the scheme have less than six accurate digits, at the present state
  /// [s].
  double longest_short_span() const { return short_span_.longest(state(), step_.scheme()); }
  StepReport attempt(double h) { return attempt(h, state().time + h); }
  /// Accepts the attempted step. @throws ComputationError if a constraint that was set aside as redundant contradicts
  /// the others
  /// @returns whether a component has left the branch on which the step was computed: `begin_branch` must then be
  /// called
  bool accept();
  /// Attempts and accepts a step that must succeed. @throws ComputationError naming time and equation
  StepReport step(double h);

  /// Changes an entry of a component's memory from the present time on.
  void set_memory(int place, double value) { step_.state().memory[place] = value; }

  /// Sets the size of the next attempts: updates the algorithmic values that depend on the step size.
  void change_step(double h);
  /// Recomputes the algorithmic values for steps of size h from consistent velocities, accelerations and multipliers.
  void restart(double h);
  /// Forces or constraints have changed at this time: components begin another branch, and velocities, accelerations
  /// and multipliers are set to those just after it. A constraint that is switched on during relative motion stops it
  /// by an inelastic impulse, the smallest change of velocities in the norm of kinetic energy. Several branches may
  /// begin at the same time; after the last one, `start_branch` must be called.
  /// @param crossed  the events that occurred, by number
  Jump begin_branch(double h, const std::vector<int>& crossed);
  /// Computes the algorithmic values for steps of size h on the new branch. The change of energy by these values, of
  /// second order in h, is an error of the steps and no part of the jump. @param time  time of the jump
  void start_branch(double h, double time);
  /// The state at the end of the last attempt.
  const State& attempted() const { return step_.trial(); }
  /// Attempts differ little in size while an event is located: one factorisation of the tangent is then used for all of
  /// them.
  void share_factors(bool shared) { newton_.share_factors(shared); }

  const System& system() const { return system_; }
  const Environment& environment() const { return environment_; }
  const State& state() const { return step_.state(); }
  const State& previous() const { return step_.trial(); }  ///< state before the last accepted step
  /// Interpolates between the previous and the last accepted step, with the order of the scheme.
  /// @param time  time within the last step [s]
  State interpolated(double time) const { return step_.interpolated(time); }
  /// Local error of the attempted step for the dofs (dofs), exact minus computed.
  VectorX position_error() const { return step_.position_error(); }
  /// Local error of the first-order unknowns (first_orders); zero if it is not known: in the first step, and in the
  /// first after a jump of forces.
  VectorX first_order_error() const { return step_.first_order_error(); }
  bool first_order_error_known() const {
    return step_.rates().Y_rate_known || system_.first_orders() == static_cast<int>(system_.algebraic().size());
  }
  /// Returns a warning if joints rotate far in the last accepted step; otherwise empty.
  std::string caution() { return correction_.caution(step_); }
  /// Energy removed by the scheme's own damping since the start [J]. It is zero for a scheme without damping (rho = 1,
  /// Newmark).
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
  bool accept_trial();
  bool accept_short();
  StepReport attempt_from(double h, double end, bool extrapolated);

  const System& system_;
  Environment environment_;
  SchemeStep step_;
  VelocityCorrection correction_;
  StepNewton newton_;
  EventFunctionValues event_function_values_;
  Extrapolation extrapolation_;
  SchemeLoss loss_;
  ShortSpan short_span_;
  Samplers samplers_;
  Echoes echoes_;
  VectorX highest_;  ///< buffer: SchemeStep::get_highest
  StartReport start_report_;
  double end_ = 0;      ///< end of the last attempt [s]
  bool short_ = false;  ///< whether it was over a short span
};

}  // namespace bielle::mechanism
