// Generalised-alpha on the configuration group: one step as a page of verbs.
//
//   Dq       = h v_n + h^2 (1/2 - beta) A_n + h^2 beta A_{n+1},      q_{n+1} = q_n o exp(Dq)
//   v_{n+1}  = v_n + h (1 - gamma) A_n + h gamma A_{n+1}
//   (1 - alpha_m) A_{n+1} + alpha_m A_n = (1 - alpha_f) a_{n+1} + alpha_f a_n
//   r(q, v, a, lambda, t)_{n+1} = 0,  Phi(q, t)_{n+1} = 0
// solved for Dq and lambda_{n+1} with the matrix K T(Dq) + gamma' C + beta' M, gamma' = gamma/(beta h),
// beta' = (1 - alpha_m)/((1 - alpha_f) beta h^2). First-order unknowns use the velocity formula with their own rates;
// algebraic ones have none, and satisfy their equations f(y, q, v, t)_{n+1} = 0 as they are.
//
// The form above, of index 3, keeps the constraints of positions. Where they turn fast it is unstable unless velocities
// are corrected after each step (velocity_correction.cpp). The stabilised form (stabilised_step.hpp) keeps the
// constraints of velocities as well, at twice the number of unknowns.
//
// Second order in positions and velocities; in multipliers and accelerations from the first step only with the start
// values
//   A_0 = a_0 + delta h j,   v_0 <- v_0 + h^2 w,   [M B^T; B 0][w; mu] = [0; B c],   c = C_q j + [0; Omega x
//   Omegadot]/12,
// delta = alpha_m - alpha_f, C_q = -(1 + 3 delta^2)/12, j the rate of the consistent acceleration. Across a change of
// the step from h to h' likewise: A_n += delta (h' - h) j, v_n += (h'^2 - h^2) w, j = (A_n - A_{n-1})/h.
//
// O. Bruls, A. Cardona, M. Arnold, Mech. Mach. Theory 48 (2012) 121; M. Arnold, O. Bruls, A. Cardona, Numer. Math. 129
// (2015) 149 (order of the multipliers).
#pragma once

#include <cmath>
#include <exception>
#include <memory>
#include <string>

#include "mechanism/solvers/consistent_start.hpp"
#include "mechanism/solvers/reaction_norm.hpp"
#include "mechanism/solvers/scheme.hpp"
#include "mechanism/solvers/stabilised_step.hpp"
#include "mechanism/system/archive.hpp"

namespace bielle::mechanism {

/// How constraints are kept: those of positions alone; with velocities that are corrected after each step
/// (velocity_correction.cpp); those of velocities as well.
enum class ConstraintForm { position, corrected, stabilised };

/// What a step did.
struct StepReport {
  double size = 0;            ///< h [s]
  int iterations = 0;         ///< linear solves of Newton's method
  int factorisations = 0;     ///< of the tangent
  int shortened = 0;          ///< iterations whose full step was too long
  int worst_equation = -1;    ///< farthest from its tolerance at the end; -1: none is off at all
  double worst_residual = 0;  ///< of that equation, in its units
  double worst_ratio = 0;     ///< over its tolerance
  std::string refusal;        ///< why the step failed; empty when it did not
  bool converged() const { return refusal.empty(); }
};

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
  /// All that the motion goes on from. What comes after does not depend on whether it was interrupted here: pivots of
  /// the tangent are chosen anew in both cases.
  void exchange(Archive& archive);

  /// Sets the algorithmic start values for steps of size h. Call once before the first step.
  void start(double h);
  /// Tries a step. The motion stays where it is until `accept`; what went wrong is in the report.
  /// @param end   the time at its end: state().time + h but for rounding [s]
  /// @param kink  forces may jump at the end: the step sees those of just before
  StepReport attempt(double h, double end, bool kink = false);
  StepReport attempt(double h) { return attempt(h, state_.time + h); }
  /// Makes the attempted step the motion's last. @throws ComputationError when a constraint that was set aside as
  /// redundant contradicts the others
  /// @returns whether a component has left the branch that the step was computed on: `begin_branch` is wanted
  bool accept();
  /// Both, for a step that has to succeed. @throws ComputationError naming time and equation
  StepReport step(double h);

  /// Changes what a component remembers, from here on.
  void set_memory(int place, double value) { state_.memory[place] = value; }

  /// The next attempts will be of size h: renews the algorithmic values that belong to a step size.
  void change_step(double h);
  /// Algorithmic values for steps of size h anew, from velocities, accelerations and multipliers that are consistent.
  void restart(double h);
  /// Forces or constraints have changed at this time: components begin another branch, and velocities, accelerations
  /// and multipliers are those of just after. What comes into force on relative motion stops it by an inelastic
  /// impulse, the least change of velocities in the kinetic energy's norm.
  /// @param crossed  the crossings that were met, by number
  Jump begin_branch(double h, const std::vector<int>& crossed);
  /// The end of the last attempt.
  const State& attempted() const { return next_; }
  /// While a crossing is located, attempts differ little in size: factors of the tangent serve them all.
  void share_factors(bool shared) { factors_serve_within_ = shared ? 0.1 : same; }

  const System& system() const { return system_; }
  const Environment& environment() const { return environment_; }
  const State& state() const { return state_; }
  const State& previous() const { return next_; }  ///< before the last accepted step
  /// Between the previous and the last accepted step, to the order of the scheme.
  /// @param time  within the last step [s]
  State interpolated(double time) const;
  /// Local error of the attempted step: of the dofs (dofs), exact minus computed.
  VectorX position_error() const;
  /// The same of the first-order unknowns (first_orders); zero where it is not known: in the first step, and in the
  /// first behind a jump of forces.
  VectorX first_order_error() const;
  bool first_order_error_known() const {
    return Y_rate_known_ || system_.first_orders() == static_cast<int>(system_.algebraic().size());
  }
  /// What the user should know of the last accepted step, whose joints turn far: a sentence, or nothing.
  std::string caution() const;
  const StartReport& start_report() const { return start_report_; }

 private:
  static constexpr int never_measured = 1 << 20;
  /// Sizes of steps that differ by rounding are the same.
  static constexpr double same = 1e-9;
  static bool same_size(double h, double other, double within = same) { return std::abs(h - other) <= within * other; }
  void allocate();
  void take_rates();                                ///< of the state, as algorithmic values
  void start_anew(double h, StartReport& report);
  void set_start_values(double h);
  VectorX acceleration_rate(double h);              ///< j
  bool resolved(const VectorX& j, double h) const;  ///< accelerations change little within a step
  VectorX velocity_target(const State& state, const VectorX& v, const VectorX& a, const VectorX& j) const;
  void perturb_velocity(const VectorX& j, double factor);
  VectorX across_constraints(const State& state);
  double turn_of_constraints() const;  ///< in the attempted step [rad]
  void correct_velocity();             ///< of the attempt
  void watch_turns();                  ///< of constraints: corrects velocities once they are fast
  void predict(double h, double end);
  void calc_prediction(double h, VectorX& dq, VectorX& v, VectorX& y) const;
  void move(double part);  ///< the attempt, by a part of the last solution
  void move_and_follow(double part);
  void still_algebraic();
  void evaluate();  ///< residual and its scale at the attempt
  double size_of_residual() const;
  void improve(StepReport& report);
  void factor(StepReport& report);
  void solve();
  void polish();
  void shorten(double before, std::exception_ptr refusal, StepReport& report);
  bool reached(const StepReport& report);
  bool within_tolerance();
  bool finite(const StepReport& report) const;
  void check_turns() const;
  VectorX algorithmic_acceleration() const;  ///< A_{n+1} of the attempt
  VectorX algorithmic_rate() const;          ///< Y_{n+1}

  const System& system_;
  Environment environment_;
  Scheme scheme_;
  State state_, next_;
  StartReport start_report_;
  LinearStep linear_;
  NewtonOptions options_;
  Convergence convergence_;
  double end_ = 0;        ///< of the last attempt [s]
  double h_ = 0;          ///< the step size that v_ and A_ belong to
  double attempted_ = 0;  ///< size of the last attempt
  VectorX v_, a_, A_;     ///< of the dofs at the last accepted time
  VectorX j_;             ///< rate of A over the last accepted step
  VectorX Y_;             ///< algorithmic rates of the first-order unknowns
  VectorX Y_rate_;        ///< and their rate over the last accepted step
  bool Y_rate_known_ = false;
  VectorX dq_, v_new_, a_new_;  ///< of the attempt
  VectorX r_, delta_;
  VectorX r_evaluated_;  ///< an evaluation that fails leaves r_ as it was
  ResidualScale scale_;
  double rate_factor_ = 0, acceleration_factor_ = 0, first_order_factor_ = 0;  ///< gamma', beta', and of y
  double size_ = 0, size_before_ = 0;           ///< of the residual, now and an iteration before: Convergence::size_of
  double factored_for_ = 0;                     ///< the step size that the factors belong to; 0: none that serve
  double factors_serve_within_ = same;          ///< relative difference of sizes that factors serve
  int floor_age_ = never_measured;              ///< steps since the rounding floor was measured
  std::unique_ptr<StabilisedStep> stabilised_;  ///< of that form only
  ConstraintForm form_;
  double turn_ = 0;                     ///< of constraints in the last accepted step [rad]
  bool turning_ = false;                ///< fast enough for velocities to be corrected, now or before
  MassSaddle saddle_;
  ReadReactions reactions_;
  VectorX eta_, mu_;                    ///< of the attempt: see there
  VectorX last_dq_;                     ///< of the last accepted step
};

}  // namespace bielle::mechanism
