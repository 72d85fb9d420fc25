// The equations of a step for Newton's method: residual, factors and solution at a trial state.
//
//   r(q, v, a, lambda, y, y', t)_{n+1} = 0,   Phi(q, t)_{n+1} = 0
// solved for Dq, the first-order unknowns and lambda_{n+1} with the matrix K T(Dq) + gamma' C + beta' M. This form, of
// index 3, satisfies the constraints of positions; the stabilised form (stabilised_equations.hpp) satisfies those of
// velocities too.
#pragma once

#include "mechanism/solvers/dynamics/scheme_step.hpp"
#include "mechanism/solvers/dynamics/step_costs.hpp"
#include "mechanism/solvers/newton/newton_matrix.hpp"

namespace bielle::mechanism {

class StepEquations {
 public:
  explicit StepEquations(const System& system) : system_(system), linear_(system) {}
  virtual ~StepEquations() = default;
  StepEquations(const StepEquations&) = delete;
  StepEquations& operator=(const StepEquations&) = delete;

  /// Number of equations. Those of the system come first.
  virtual int size() const { return system_.size(); }
  /// Begins a step from the accepted state.
  virtual void begin(const State& /*state*/, const Environment& /*environment*/) {}
  /// @param r  (size)
  virtual void calc_residual(const State& trial, const Environment& environment, VectorX& r,
                             ResidualScale& scale) const;
  /// Assembles and factorises the matrix at the trial. @throws ComputationError naming an unknown if the matrix is
  /// singular
  virtual void factor(const SchemeStep& step, const Environment& environment);
  /// delta = -(matrix)^-1 r. @param r,delta (size)
  virtual void solve(const VectorX& r, VectorX& delta) const { linear_.solve(r, delta); }
  /// Moves the trial by a fraction of the solution.
  virtual void move(SchemeStep& step, const VectorX& delta, double part) { step.move(delta, part); }
  /// Recomputes the trial's rates from its increments.
  virtual void follow(SchemeStep& step) const { step.follow(nullptr); }
  /// Returns the residual that is compared with the tolerance (system.size()). @param h  size of the step [s]
  virtual const VectorX& judged(const VectorX& r, double /*h*/) { return r; }
  /// Costs of these operations with the last factors.
  virtual StepCosts costs() const { return count_costs(system_, size(), 1, linear_.factor_cost()); }
  virtual void choose_pivots_anew() { linear_.choose_pivots_anew(); }
  const NewtonMatrix& linear() const { return linear_; }  ///< the tangent of the system's own equations

 protected:
  const System& system_;
  NewtonMatrix linear_;
};

}  // namespace bielle::mechanism
