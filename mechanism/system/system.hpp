// A mechanism ready to compute: numbered unknowns, residual, weighted tangent, energies, and names for messages.
//
// Unknowns, in this order: independent increments of the nodes, amplitudes, first-order unknowns, multipliers.
// Equations likewise. "dofs" are the first two: what has inertia.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanism/math/condensed.hpp"
#include "mechanism/system/branches.hpp"
#include "mechanism/system/idle_constraints.hpp"
#include "mechanism/system/residual_assembly.hpp"
#include "mechanism/system/tangent_assembly.hpp"

namespace bielle::mechanism {

class System {
 public:
  /// Declares and numbers all components. Keeps a reference: the model must outlive the system.
  /// @throws InputError when components refer to each other in a circle
  explicit System(const Model& model);
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  /// Threads that evaluate costly components and condense their amplitudes; one, unless this is called. Results are the
  /// same for any number.
  void use_threads(int threads) { work_.use_threads(threads); }
  Workers& workers() const { return work_.workers(); }

  const Model& model() const { return model_; }
  const NodeKinematics& kinematics() const { return kinematics_; }
  const std::vector<Slots>& slots() const { return unknowns_.slots(); }  ///< of the model's members, in their order

  int dofs() const { return unknowns_.dofs(); }
  int first_orders() const { return unknowns_.first_orders(); }
  int multipliers() const { return unknowns_.multipliers(); }
  int size() const { return unknowns_.size(); }
  Kind kind(int unknown) const { return unknowns_.kind(unknown); }
  ConstraintKind constraint_kind(int multiplier) const { return unknowns_.constraint_kind(multiplier); }
  bool yields(int multiplier) const { return unknowns_.yields(multiplier); }  ///< to constraints that it repeats
  /// Typical size of an unknown [its units], as its component declares it; 0: none is known.
  double scale(int unknown) const { return unknowns_.scale(unknown); }
  /// First-order unknowns whose equations hold no rates of theirs, ascending, counted among the first-order ones.
  const std::vector<int>& algebraic() const { return unknowns_.algebraic(); }
  /// Those that a static analysis may leave where they are (Declaration::Scalar::holdable), likewise.
  const std::vector<int>& holdable() const { return unknowns_.holdable(); }
  /// "rotation y of node 'pin'", "mode 3 of element 'rod'"
  std::string unknown_name(int unknown) const { return unknowns_.name(unknown); }
  /// "moment y at node 'pin'", "constraint x of joint 'main'"
  std::string equation_name(int equation) const { return unknowns_.equation_name(equation); }
  /// As declared. Otherwise N and N m of nodes; of amplitudes in m, rad and m kg^0.5: N, N m and N/sqrt(kg); of
  /// first-order unknowns their units per second, or as they are where the equation holds no rate; of constraints m or
  /// rad, of those that relate velocities m/s or rad/s.
  std::string equation_units(int equation) const { return unknowns_.equation_units(equation); }
  /// The first component whose position is on a wrong branch, with what is wrong: "joint 'main': its axes point in
  /// opposite directions"; or nothing.
  std::string wrong_branch(const State& state, const Environment& environment) const;

  /// Takes redundant constraints out of the equations: their multipliers stay zero. Components none of whose rows are
  /// among them may choose the axes of their rows from here on. Call before solvers are made.
  void set_aside(const std::vector<int>& multipliers);
  const std::vector<int>& set_aside() const { return idle_.set_aside(); }
  /// Calls act(multiplier) for each constraint that is out of the equations at a state, ascending.
  template <class Act>
  void for_each_idle(const State& state, const Act& act) const {
    idle_.for_each(state, act);
  }
  /// Calls act(multiplier) for those of them that are redundant.
  template <class Act>
  void for_each_redundant(const State& state, const Act& act) const {
    for_each_idle(state, [&](int multiplier) {
      if (state.idle.empty() || state.idle[static_cast<std::size_t>(multiplier)] == Idle::redundant) act(multiplier);
    });
  }
  /// Whether constraints can be switched off and on during a run.
  bool switches() const { return idle_.switches(); }
  /// Sets `idle` of the switched constraints from what components remember; the others count as active. Nothing where
  /// no constraint can be switched.
  void switch_constraints(State& state, const Environment& environment) const {
    idle_.switch_constraints(state, environment);
  }
  /// Whether forces depend on reactions, or have kinks that end no step.
  bool reads_reactions() const { return branches_.reads_reactions(); }
  bool has_kinks() const { return branches_.has_kinks(); }
  /// Whether values of crossings depend on reactions.
  bool crossings_read_reactions() const { return branches_.crossings_read_reactions(); }

  const std::vector<MemberCrossing>& crossings() const { return branches_.crossings(); }
  /// Values of all crossings (crossings().size()).
  void calc_crossings(const State& state, const Environment& environment, Eigen::Ref<VectorX> values) const {
    branches_.calc_crossings(state, environment, values);
  }
  /// The value of one, by number.
  double calc_crossing(const State& state, const Environment& environment, int crossing) const {
    return branches_.calc_crossing(state, environment, crossing);
  }
  /// Components renew what they remember where a branch of the motion begins. @param crossed  numbers of crossings
  void begin_branch(State& state, const Environment& environment, const std::vector<int>& crossed = {}) const;
  /// Components forget what they remember of rates, or choose by those that are known (Component::begin_motion).
  /// @returns whether constraints have been switched
  bool begin_motion(State& state, const Environment& environment, bool known) const;
  /// The member that a component is; the component must be of the model.
  std::size_t member_of(const Component& component) const { return unknowns_.member_of(component); }
  /// The slots of a component of the model.
  const Slots& slots_of(const Component& component) const { return slots()[member_of(component)]; }

  /// State of the input file at a time: positions and rates as given, start values of scalars, multipliers zero.
  State start(double time) const;
  /// state = base o exp(dq) at state.time, with the part state.motion_factor of prescribed motions. @param dq (dofs)
  void displace(State& state, const State& base, const Eigen::Ref<const VectorX>& dq) const;
  void set_rates(State& state, const Eigen::Ref<const VectorX>& v, const Eigen::Ref<const VectorX>& a) const;
  void get_rates(const State& state, Eigen::Ref<VectorX> v, Eigen::Ref<VectorX> a) const;

  /// r (size) of all equations. @param scale  if given, receives the largest contributions
  void residual(const State& state, const Environment& environment, Eigen::Ref<VectorX> r,
                ResidualScale* scale = nullptr) const;
  /// The part of one member of the model in it.
  void residual_part(std::size_t member, const State& state, const Environment& environment,
                     Eigen::Ref<VectorX> r) const {
    residual_.set_part(member, state, environment, r);
  }
  const SparsePattern& pattern() const { return tangent_.pattern(); }
  /// The same, with the amplitudes that are condensed before a factorisation.
  const CondensedPattern& condensed_pattern() const { return *condensed_; }
  /// Amplitudes of each component that couple to its own unknowns alone, ascending.
  std::vector<std::vector<int>> lone_amplitudes() const { return tangent_.lone_amplitudes(); }
  /// Values of the weighted tangent in the pattern's order.
  /// @param dq  increment since the base of the step, for T(Dq); nullptr: zero
  void tangent(const State& state, const Environment& environment, const TangentWeights& weights, const VectorX* dq,
               std::vector<double>& values) const;
  /// First and second time derivatives of the constraint rows at the state's rates. Vectors (multipliers).
  void constraint_rates(const State& state, const Environment& environment, Eigen::Ref<VectorX> velocity,
                        Eigen::Ref<VectorX> acceleration) const;
  /// Sums of the components, and the power of the supports that move nodes.
  Energy energy(const State& state, const Environment& environment) const;
  /// Times at which forces or prescribed motions have kinks, ascending, each once.
  std::vector<double> break_points() const;
  /// Ends a converged step: components renew their memory; rotation matrices are made orthonormal again.
  /// @returns whether a component has left the branch that the step was computed on: the motion is started anew
  bool accept(State& state, const Environment& environment) const;

 private:
  void build_pattern();

  const Model& model_;
  NodeKinematics kinematics_;
  Unknowns unknowns_;
  SharedWork work_;
  ResidualAssembly residual_;
  TangentAssembly tangent_;
  IdleConstraints idle_;
  Branches branches_;
  std::unique_ptr<const CondensedPattern> condensed_;
};

}  // namespace bielle::mechanism
