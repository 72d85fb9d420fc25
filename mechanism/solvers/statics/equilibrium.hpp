// Newton's method for the equations of rest at a fixed load factor.
#pragma once

#include <string>

#include "mechanism/solvers/constraints/reaction_norm.hpp"
#include "mechanism/solvers/newton/balance_search.hpp"
#include "mechanism/solvers/newton/convergence.hpp"
#include "mechanism/solvers/statics/bordering.hpp"
#include "mechanism/solvers/statics/load_ramp.hpp"
#include "mechanism/solvers/statics/static_tangent.hpp"

namespace bielle::mechanism {

/// A point of Newton's continuation: what Newton's method would change there, and how the equilibrium goes on.
struct Continuation {
  VectorX correction;  ///< c = -K^-1 r (size)
  VectorX second;      ///< the next one with the same factors: what the correction has left (size)
  VectorX rate;        ///< b = -K^-1 dr/ds (size), s the load factor
};

class Equilibrium {
 public:
  /// @param further  unknowns besides those of the system; nullptr: none. It must outlive this
  Equilibrium(const LoadRamp& ramp, const NewtonOptions& options, Bordering* further = nullptr);

  /// To be called where an analysis sets off: what nothing holds there stays where it is, see StaticTangent.
  void look_for_loose(double factor, const State& state) { tangent_.look_for_loose(state, ramp_.environment(factor)); }
  const VectorX* held() const { return tangent_.held(); }

  /// Brings a state at rest into equilibrium under a load factor. Prescribed motions are taken along in the first
  /// iteration: the free nodes follow them by the tangent. Stiffness comes from predicted stress (Environment::before);
  /// steps are shortened that turn a node by more than two radians, or that a component refuses.
  /// @returns the iterations, or -1 with the state as it was; then `why` tells
  /// @param before  from where one linear step led to the state, or null
  int find(double factor, State& state, const State* before = nullptr);
  /// The same with exact tangents, and steps that are shortened where they make the largest residual larger: slower
  /// where both find it, and now and then the only way.
  int search(double factor, State& state);
  /// Goes down to an equilibrium from afar, also where nothing but inertia resists at first (an arm that is to hang):
  /// pseudo-transient continuation, (K + M/tau^2) dq = -r with tau growing as the residual falls, from steps of a tenth
  /// of the mechanism's size on (C. T. Kelley, D. E. Keyes, SIAM J. Numer. Anal. 35 (1998) 508). Returns as `find`.
  int relax(double factor, State& state);
  /// Forces (dofs) that are added to the loads until others are given, or none (size 0).
  void push(const VectorX& forces) { push_ = forces; }
  /// Linear solves so far, those of attempts that failed included.
  long solves() const { return solves_; }
  /// Whether the last `find` met a load on something that nothing holds (an arm drawn away from where it hangs):
  /// `relax` lets it go down.
  bool falls() const { return falls_; }
  /// The first iteration of the last `find` or `search` (size): the linear response to the increment, motions included.
  const VectorX& first_response() const { return first_response_; }
  /// Whether the determinant's sign was another one in its last iteration than in its first.
  bool sign_changed() const { return last_sign_ != first_sign_; }
  /// The linear response (size) of an equilibrium that was just found to a change of the load factor, with the factors
  /// of the last iteration.
  VectorX response(double factor, const State& state, double change);
  /// Newton's continuation at a state: one factorisation. @param before  the point from which one step led to it, or
  /// null; @throws ComputationError where a component refuses the state or the equations are singular
  void respond(double factor, State& state, const State* before, Continuation& point);
  /// Why the last attempt failed: what a component refused, what is singular, or where Newton's method stalled.
  const std::string& why() const { return why_; }
  /// Hands an equilibrium to the components, constraints set aside included.
  /// @throws ComputationError with the load factor and the residual when one refuses it
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
  /// An iteration of Newton's method that takes prescribed motions along. @returns false where nothing is prescribed
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
  double longest_arm_of_inertia(const State& state, LinearStep& mass) const;
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
  bool searches_ = false;    ///< balances that may be flat are searched for at each iterate
  Environment environment_;  ///< of the load factor in hand
  State start_;              ///< of the attempt in hand
  VectorX first_response_;
  int first_sign_ = 0, last_sign_ = 0;  ///< of the determinant
  bool follows_ = false;                ///< something is prescribed that moves with the load factor
  State before_;                        ///< the last step led from it to the state in hand
  bool stepped_ = false;                ///< there was such a step
  bool falls_ = false;
  VectorX push_;
  Bordering* further_;
  /// Forces (dofs) along what nothing holds that are taken for none: rounding next to what they balance. Or none (size
  /// 0).
  VectorX balanced_;
  double length_ = 0;  ///< of the mechanism by its masses, while `relax` goes on [m]; 0: not looked at
  long solves_ = 0;
  VectorX r_, delta_;
  ResidualScale scale_;
  bool judged_ = false;  ///< a residual of this attempt has been compared with its tolerances
  std::string why_;
};

}  // namespace bielle::mechanism
