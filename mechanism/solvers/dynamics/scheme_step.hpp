// A step of generalised-alpha on the configuration group: values at the last accepted time, and a trial state at the
// step's end.
//
//   Dq       = h v_n + h^2 (1/2 - beta) A_n + h^2 beta A_{n+1},      q_{n+1} = q_n o exp(Dq)
//   v_{n+1}  = v_n + h (1 - gamma) A_n + h gamma A_{n+1}
//   (1 - alpha_m) A_{n+1} + alpha_m A_n = (1 - alpha_f) a_{n+1} + alpha_f a_n
//
// First-order unknowns use the velocity formula with their own rates; algebraic ones have none. For the increments Dq
// and the dependent unknowns,
//   dv = gamma' dDq,  da = beta' dDq,   gamma' = gamma/(beta h),  beta' = (1 - alpha_m)/((1 - alpha_f) beta h^2).
//
// O. Bruls, A. Cardona, M. Arnold, Mech. Mach. Theory 48 (2012) 121.
#pragma once

#include "mechanism/model/archive.hpp"
#include "mechanism/solvers/dynamics/scheme.hpp"
#include "mechanism/system/system.hpp"

namespace bielle::mechanism {

class SchemeStep {
 public:
  /// Rates at the last accepted time, including those of the scheme.
  struct Rates {
    VectorX v, a;               ///< rates of the dofs
    VectorX A;                  ///< algorithmic acceleration
    VectorX j;                  ///< rate of A over the last accepted step
    VectorX Y;                  ///< algorithmic rates of the first-order unknowns
    VectorX Y_rate;             ///< rate of Y over the last accepted step
    bool Y_rate_known = false;  ///< false in the first step, and in the first after a jump of forces
  };

  SchemeStep(const System& system, const Scheme& scheme, State state);
  void exchange(Archive& archive);

  const System& system() const { return system_; }
  const Scheme& scheme() const { return scheme_; }
  State& state() { return state_; }  ///< at the last accepted time
  const State& state() const { return state_; }
  Rates& rates() { return rates_; }
  const Rates& rates() const { return rates_; }
  void take_rates();  ///< sets all rates from the state, also the algorithmic ones
  void set_rates() { system_.set_rates(state_, rates_.v, rates_.a); }
  double size() const { return size_; }  ///< step size of the algorithmic values [s]
  void set_size(double h) { size_ = h; }

  /// Gets the starting values of a trial: accelerations, rates of the first-order unknowns (values of algebraic ones)
  /// and multipliers of the accepted state. @param values (system.size())
  void get_highest(VectorX& values) const;

  // -- the trial
  /// @param end      end time of the trial [s]
  /// @param highest  starting values, as from `get_highest`
  void begin(double h, double end, const VectorX& highest);
  double trial_size() const { return trial_size_; }  ///< h [s]
  const VectorX& dq() const { return dq_; }
  State& trial() { return trial_; }
  const State& trial() const { return trial_; }  ///< after `accept`: the state before the accepted step
  const VectorX& trial_velocity() const { return v_; }
  const VectorX& trial_acceleration() const { return a_; }
  VectorX algorithmic_acceleration() const;  ///< A_{n+1} of the trial; call before `take_algorithmic_values`
  void set_trial_velocity(const VectorX& v);
  /// Moves increments, rates and multipliers by a fraction of an iteration's solution. @param delta (>= system.size())
  void move(const VectorX& delta, double part);
  /// Moves positions by a change without rates (the stabilised form).
  void move_positions(const Eigen::Ref<const VectorX>& change) { dq_ += change; }
  /// Recomputes the rates from the increments. Moving forward and back leaves rounding errors in increments and rates,
  /// and Newton's method, which moves them together, would never remove the resulting error in the scheme's relations.
  /// @param without_rates  the part of the increments that has no rates, or nullptr
  void follow(const VectorX* without_rates);
  /// Sets the trial to a state that was found by another method. @param dq  the increments that lead to it (dofs)
  void set_trial(State trial, double h, const VectorX& dq);
  void show();  ///< copies increments and rates to the trial state
  TangentWeights weights() const { return {1, rate_factor_, acceleration_factor_, first_order_factor_, 1}; }
  /// @throws ComputationError if a node rotates so far that T(Dq) is inaccurate: it is singular at a full turn
  void check_turns() const;

  /// Algorithmic values at the end of the trial become those of the accepted time. Call it before `accept`.
  void take_algorithmic_values();
  void accept();  ///< the trial becomes the accepted state

  /// Local error of the trial for the dofs (dofs), exact minus computed.
  VectorX position_error() const;
  /// Local error of the first-order unknowns (first_orders); zero if it is not known.
  VectorX first_order_error() const;
  /// Interpolates between the previous and the accepted state, with the order of the scheme. @param time [s]
  State interpolated(double time) const;

 private:
  VectorX algorithmic_rate() const;  ///< Y_{n+1}
  /// Computes increments, velocities and first-order unknowns from accelerations and rates at the end of a step.
  void calc_end(const VectorX& a, const VectorX& rate, VectorX& dq, VectorX& v, VectorX& y) const;
  void still_algebraic();
  template <class Act>
  void for_each_rotation(const Act& act) const;

  const System& system_;
  Scheme scheme_;
  State state_, trial_;
  Rates rates_;
  double size_ = 0, trial_size_ = 0;
  VectorX dq_, v_, a_;                                                         ///< increments and rates of the trial
  VectorX last_dq_;                                                            ///< increments of the last accepted step
  VectorX dq_0_, v_0_, y_0_;                                                   ///< buffers for `follow`
  double rate_factor_ = 0, acceleration_factor_ = 0, first_order_factor_ = 0;  ///< gamma', beta', and the factor of y
};

}  // namespace bielle::mechanism
