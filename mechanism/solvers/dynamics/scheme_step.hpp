// A step of generalised-alpha on the configuration group: values at the last accepted time, and a trial state at the
// step's end.
//
//   Dq       = h v_n + h^2 (1/2 - beta) A_n + h^2 beta A_{n+1},      q_{n+1} = q_n o exp(Dq)
//   v_{n+1}  = v_n + h (1 - gamma) A_n + h gamma A_{n+1}
//   (1 - alpha_m) A_{n+1} + alpha_m A_n = (1 - alpha_f) a_{n+1} + alpha_f a_n
//
// First-order unknowns use the velocity formula with their own rates; algebraic ones have none. Of the increments Dq
// and what belongs to them,
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
  /// Rates at the last accepted time, those of the scheme's own included.
  struct Rates {
    VectorX v, a;               ///< of the dofs
    VectorX A;                  ///< algorithmic acceleration
    VectorX j;                  ///< rate of A over the last accepted step
    VectorX Y;                  ///< algorithmic rates of the first-order unknowns
    VectorX Y_rate;             ///< and their rate over the last accepted step
    bool Y_rate_known = false;  ///< not in the first step, nor in the first after a jump of forces
  };

  SchemeStep(const System& system, const Scheme& scheme, State state);
  void exchange(Archive& archive);

  const System& system() const { return system_; }
  const Scheme& scheme() const { return scheme_; }
  State& state() { return state_; }  ///< at the last accepted time
  const State& state() const { return state_; }
  Rates& rates() { return rates_; }
  const Rates& rates() const { return rates_; }
  void take_rates();  ///< of the state, as algorithmic ones too
  void set_rates() { system_.set_rates(state_, rates_.v, rates_.a); }
  double size() const { return size_; }  ///< that the algorithmic values belong to [s]
  void set_size(double h) { size_ = h; }

  /// What a trial starts from: accelerations, rates of the first-order unknowns (values of algebraic ones) and
  /// multipliers of the accepted state. @param values (system.size())
  void get_highest(VectorX& values) const;

  // -- the trial
  /// @param end      its time [s]
  /// @param highest  what the trial starts from, as `get_highest` gives it
  void begin(double h, double end, const VectorX& highest);
  double trial_size() const { return trial_size_; }  ///< h [s]
  const VectorX& dq() const { return dq_; }
  State& trial() { return trial_; }
  const State& trial() const { return trial_; }  ///< after `accept`: the state before the accepted step
  const VectorX& trial_velocity() const { return v_; }
  const VectorX& trial_acceleration() const { return a_; }
  VectorX algorithmic_acceleration() const;  ///< A_{n+1} of the trial, before `take_algorithmic_values`
  void set_trial_velocity(const VectorX& v);
  /// Moves increments, rates and multipliers by a part of an iteration's solution. @param delta (>= system.size())
  void move(const VectorX& delta, double part);
  /// Moves positions by what belongs to no rates (the stabilised form).
  void move_positions(const Eigen::Ref<const VectorX>& change) { dq_ += change; }
  /// Makes the rates those of the increments again. A way there and back leaves rounding of its own size in increments
  /// and rates, and Newton's method, which moves them together, would never take out what they then lack of the
  /// scheme's relations.
  /// @param without_rates  the part of the increments that belongs to no rates, or nullptr
  void follow(const VectorX* without_rates);
  /// Makes a state that was found by other means the trial. @param dq  the increments that lead there (dofs)
  void set_trial(State trial, double h, const VectorX& dq);
  void show();  ///< increments and rates in the trial state
  TangentWeights weights() const { return {1, rate_factor_, acceleration_factor_, first_order_factor_, 1}; }
  /// @throws ComputationError where a node turns so far that T(Dq) is not to be trusted: singular at a full turn
  void check_turns() const;

  /// Algorithmic values at the end of the trial become those of the accepted time. Comes before `accept`.
  void take_algorithmic_values();
  void accept();  ///< the trial becomes the accepted state

  /// Local error of the trial: of the dofs (dofs), exact minus computed.
  VectorX position_error() const;
  /// The same of the first-order unknowns (first_orders); zero where it is not known.
  VectorX first_order_error() const;
  /// Between the previous and the accepted state, to the order of the scheme. @param time [s]
  State interpolated(double time) const;

 private:
  VectorX algorithmic_rate() const;  ///< Y_{n+1}
  /// Increments, velocities and first-order unknowns that go with accelerations and rates at the end of a step.
  void calc_end(const VectorX& a, const VectorX& rate, VectorX& dq, VectorX& v, VectorX& y) const;
  void still_algebraic();
  template <class Act>
  void for_each_rotation(const Act& act) const;

  const System& system_;
  Scheme scheme_;
  State state_, trial_;
  Rates rates_;
  double size_ = 0, trial_size_ = 0;
  VectorX dq_, v_, a_;                                                         ///< of the trial
  VectorX last_dq_;                                                            ///< of the last accepted step
  VectorX dq_0_, v_0_, y_0_;                                                   ///< buffers of `follow`
  double rate_factor_ = 0, acceleration_factor_ = 0, first_order_factor_ = 0;  ///< gamma', beta', and of y
};

}  // namespace bielle::mechanism
