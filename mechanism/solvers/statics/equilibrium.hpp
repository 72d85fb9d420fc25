// Newton's method for the static equations at a fixed load factor.
#pragma once

#include <string>

#include "mechanism/solvers/constraints/reaction_norm.hpp"
#include "mechanism/solvers/newton/balance_search.hpp"
#include "mechanism/solvers/newton/convergence.hpp"
#include "mechanism/solvers/statics/bordering.hpp"
#include "mechanism/solvers/statics/load_ramp.hpp"
#include "mechanism/solvers/statics/static_tangent.hpp"

namespace bielle::mechanism {

/// A point of Newton's continuation: the correction by Newton's method, and the tangent of the path of equilibria.
struct Continuation {
  VectorX correction;  ///< c = -K^-1 r (size)
  VectorX second;      ///< the next correction with the same factors (size): the remainder
  VectorX rate;        ///< b = -K^-1 dr/ds (size), with the load factor s
};

class Equilibrium {
 public:
  /// @param further  unknowns in addition to those of the system; nullptr: none. They must outlive this object
  Equilibrium(const LoadRamp& ramp, const NewtonOptions& options, Bordering* further = nullptr);

  /// Call it at the start of an analysis: unsupported motions are held there, see StaticTangent.
  void look_for_loose(double factor, const State& state) { tangent_.look_for_loose(state, ramp_.environment(factor)); }
  const VectorX* held() const { return tangent_.held(); }

  /// Brings a state at rest into equilibrium under a load factor. Prescribed motions are included in the first
  /// iteration: the free nodes follow them by the tangent. The stiffness uses predicted stress (Environment::before);
  /// steps are shortened if they rotate a node by more than two radians, or if a component cannot be evaluated.
  /// @returns the number of iterations, or -1 with the state unchanged; then `why` gives the reason
  /// @param before  state from which one linear step led to this one, or null
  int find(double factor, State& state, const State* before = nullptr);
  /// Does the same with exact tangents, and with steps that are shortened if they increase the largest residual: slower
  /// if both succeed, but sometimes the only possibility.
  int search(double factor, State& state);
  /// Finds an equilibrium from a distant state, even if only inertia resists at first (an arm that moves to its hanging
  /// position): pseudo-transient continuation, (K + M/tau^2) dq = -r with tau growing as the residual decreases, from
  /// steps of a tenth of the mechanism's size on (C. T. Kelley, D. E. Keyes, SIAM J. Numer. Anal. 35 (1998) 508). It
  /// returns the same as `find`.
  int relax(double factor, State& state);
  /// Sets forces (dofs) that are added to the loads until the next call, or none (size 0).
  void push(const VectorX& forces) { push_ = forces; }
  /// Number of linear solutions so far, including those of failed attempts.
  long solves() const { return solves_; }
  /// Returns whether the last `find` found a load on an unsupported motion (an arm away from its hanging position):
  /// `relax` can then find the equilibrium.
  bool falls() const { return falls_; }
  /// Returns the first iteration of the last `find` or `search` (size): the linear response to the increment, including
  /// motions.
  const VectorX& first_response() const { return first_response_; }
  /// Returns whether the sign of the determinant differed between its first and its last iteration.
  bool sign_changed() const { return last_sign_ != first_sign_; }
  /// Returns the linear response (size) of an equilibrium that was just found to a change of the load factor, with the
  /// factors of the last iteration.
  VectorX response(double factor, const State& state, double change);
  /// Computes Newton's continuation at a state, with one factorisation. @param before  the point from which one step
  /// led to it, or null; @throws ComputationError if a component cannot be evaluated or the equations are singular
  void respond(double factor, State& state, const State* before, Continuation& point);
  /// Reason of the last failure: a component that could not be evaluated, a singular unknown, or the equation at which
  /// Newton's method stalled.
  const std::string& why() const { return why_; }
  /// Passes an equilibrium to the components, including constraints set aside.
  /// @throws ComputationError with the load factor and the residual if one rejects it
  void accept(double factor, State& state) const;

 private:
  template <class Iterations>
  int attempt_once(const State& state, const Iterations& iterations);
  int iterate(double factor, State& state, void (Equilibrium::*improve)(State&));
  int iterate_relaxing(double factor, State& state);
  template <class Iterations>
  int attempt(double factor, State& state, const Iterations& iterations);
  std::string what_is_open(const State& state) const;
  double first_tau_squared(const State& state);
  /// Makes an iteration of Newton's method that includes prescribed motions. @returns false if nothing is prescribed
  bool follow_motions(double factor, State& state);
  void check_no_fall(const State& state);
  [[noreturn]] void fall(const State& state);
  double largest_work(const State& state, const VectorX& z) const;
  void leave_balanced_out(const State& state);
  void factor_derivative(double factor, const State& state, Eigen::Ref<VectorX> result) const;
  void note_first();
  void step(State& state);
  void search_step(State& state);
  void solve();
  double largest_turn() const;
  double extent(const State& state) const;
  double longest_arm_of_inertia(const State& state, NewtonMatrix& mass) const;
  void factor(const State& state, double inertia = 0);
  void move(State& state, const State& base, double part);
  bool reached();
  void evaluate(State& state);

  const LoadRamp& ramp_;
  const System& system_;
  NewtonOptions options_;
  StaticTangent tangent_;
  Convergence convergence_;
  ReadReactions reactions_;
  BalanceSearch search_;
  bool searches_ = false;    ///< balances that may be constant are searched for at each iterate
  Environment environment_;  ///< environment of the present load factor
  State start_;              ///< start of the present attempt
  VectorX first_response_;
  int first_sign_ = 0, last_sign_ = 0;  ///< signs of the determinant
  bool follows_ = false;                ///< some prescribed motion depends on the load factor
  State before_;                        ///< the last step led from it to the present state
  bool stepped_ = false;                ///< there was such a step
  bool falls_ = false;
  VectorX push_;
  Bordering* further_;
  /// Forces (dofs) along unsupported motions that are neglected, because they are rounding errors of balanced forces.
  /// It may be empty (size 0).
  VectorX balanced_;
  double length_ = 0;  ///< size of the mechanism by its masses, during `relax` [m]; 0: not computed
  long solves_ = 0;
  VectorX r_, delta_;
  ResidualScale scale_;
  bool judged_ = false;  ///< a residual of this attempt has been compared with its tolerances
  std::string why_;
};

}  // namespace bielle::mechanism
