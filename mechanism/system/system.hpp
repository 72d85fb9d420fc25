// A mechanism ready for computation: numbered unknowns, residual, weighted tangent, energies, and names for messages.
//
// The order of unknowns is: independent increments of the nodes, amplitudes, first-order unknowns, multipliers.
// Equations have the same order. The first two are called "dofs": they have inertia.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanism/system/branches.hpp"
#include "mechanism/system/idle_constraints.hpp"
#include "mechanism/system/residual_assembly.hpp"
#include "mechanism/system/tangent_assembly.hpp"

namespace bielle::mechanism {

class System {
 public:
  /// Declares and numbers all components. The object keeps a reference: the model must outlive the system.
  /// @throws InputError if components refer to each other in a circle
  explicit System(const Model& model);
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  /// Sets the number of threads that evaluate costly components and condense their amplitudes; the default is one.
  /// Results are the same for any number of threads.
  void use_threads(int threads) { work_.use_threads(threads); }
  Workers& workers() const { return work_.workers(); }
  const EvaluationSize& evaluation_size() const { return work_.evaluation_size(); }

  const Model& model() const { return model_; }
  const NodeKinematics& kinematics() const { return kinematics_; }
  const std::vector<Slots>& slots() const { return unknowns_.slots(); }  ///< slots of the members, in their order

  int dofs() const { return unknowns_.dofs(); }
  int first_orders() const { return unknowns_.first_orders(); }
  int multipliers() const { return unknowns_.multipliers(); }
  int size() const { return unknowns_.size(); }
  Kind kind(int unknown) const { return unknowns_.kind(unknown); }
  ConstraintKind constraint_kind(int multiplier) const { return unknowns_.constraint_kind(multiplier); }
  bool yields(int multiplier) const { return unknowns_.yields(multiplier); }  ///< if it repeats others
  /// Typical size of an unknown [its units], as its component declares it; 0 if none is known.
  double scale(int unknown) const { return unknowns_.scale(unknown); }
  /// First-order unknowns whose equations do not contain their rates, ascending, numbered among the first-order ones.
  const std::vector<int>& algebraic() const { return unknowns_.algebraic(); }
  /// First-order unknowns that may keep their values in a static analysis (Declaration::Scalar::holdable), ascending,
  /// numbered among the first-order ones.
  const std::vector<int>& holdable() const { return unknowns_.holdable(); }
  /// "rotation y of node 'pin'", "mode 3 of element 'rod'"
  std::string unknown_name(int unknown) const { return unknowns_.name(unknown); }
  /// "moment y at node 'pin'", "constraint x of joint 'main'"
  std::string equation_name(int equation) const { return unknowns_.equation_name(equation); }
  /// Units of an equation, as declared by its component. Otherwise the units are N and N m for nodes; N, N m and
  /// N/sqrt(kg) for amplitudes in m, rad and m kg^0.5; for first-order unknowns their units per second, or their units
  /// if the equation does not contain the rate; m or rad for constraints, m/s or rad/s for those that relate
  /// velocities.
  std::string equation_units(int equation) const { return unknowns_.equation_units(equation); }
  /// Returns whether a member is in the equations at a state; otherwise its entry has been released.
  bool is_active(const State& state, std::size_t member) const { return unknowns_.is_active(state, member); }
  const Activities& activities() const { return unknowns_.activities(); }
  /// Describes the first component whose position is on a wrong branch, with the reason: "joint 'main': its axes point
  /// in opposite directions"; empty if there is none.
  std::string wrong_branch(const State& state, const Environment& environment) const;

  /// Takes redundant constraints out of the equations: their multipliers stay zero. Components without such constraints
  /// may choose the axes of their rows after this call. Call this function before solvers are created.
  void set_aside(const std::vector<int>& multipliers);
  const std::vector<int>& set_aside() const { return idle_.set_aside(); }
  /// Calls act(multiplier) for each constraint that is out of the equations at a state, ascending.
  template <class Act>
  void for_each_idle(const State& state, const Act& act) const {
    idle_.for_each(state, act);
  }
  /// Calls act(multiplier) for each constraint that is out of the equations because it is redundant.
  template <class Act>
  void for_each_redundant(const State& state, const Act& act) const {
    for_each_idle(state, [&](int multiplier) {
      if (state.idle.empty() || state.idle[static_cast<std::size_t>(multiplier)] == Idle::redundant) act(multiplier);
    });
  }
  /// Returns whether constraints can be switched off and on during a run.
  bool switches() const { return idle_.switches(); }
  /// Sets `idle` of the switched constraints from the memory of their components; the others count as active. The
  /// function does nothing if no constraint can be switched.
  void switch_constraints(State& state, const Environment& environment) const {
    idle_.switch_constraints(state, environment);
  }
  /// Returns whether forces depend on reactions, or have kinks at which no step ends.
  bool reads_reactions() const { return branches_.reads_reactions(); }
  bool has_kinks() const { return branches_.has_kinks(); }
  /// Returns whether values of event functions depend on reactions.
  bool event_functions_read_reactions() const { return branches_.event_functions_read_reactions(); }

  const std::vector<MemberEventFunction>& event_functions() const { return branches_.event_functions(); }
  /// Computes the values of all event functions (event_functions().size()).
  void calc_event_functions(const State& state, const Environment& environment, Eigen::Ref<VectorX> values) const {
    branches_.calc_event_functions(state, environment, values);
  }
  /// Computes the value of one event function, by number.
  double calc_event_function(const State& state, const Environment& environment, int event_function) const {
    return branches_.calc_event_function(state, environment, event_function);
  }
  /// Components update their memory at the beginning of a branch of the motion. @param crossed  numbers of the event
  /// functions that crossed zero
  void begin_branch(State& state, const Environment& environment, const std::vector<int>& crossed = {}) const;
  /// Components that a branch has activated update their memory by the state with which it begins.
  /// @param before  memory before the branch began
  void accept_activated(State& state, const Environment& environment, const VectorX& before) const {
    branches_.accept_activated(state, environment, before);
  }
  /// Components reset the part of their memory that depends on rates, or set it from known rates
  /// (Component::begin_motion).
  /// @returns whether constraints have been switched
  bool begin_motion(State& state, const Environment& environment, bool known) const;
  /// Index of the member whose component is given; the component must belong to the model.
  std::size_t member_of(const Component& component) const { return unknowns_.member_of(component); }
  /// Slots of a component of the model.
  const Slots& slots_of(const Component& component) const { return slots()[member_of(component)]; }

  /// Returns the state of the input file at a time: positions and rates as given, start values of scalars, multipliers
  /// zero.
  State start(double time) const;
  /// Sets state = base o exp(dq) at state.time, with the fraction state.motion_factor of prescribed motions. @param dq
  /// (dofs)
  void displace(State& state, const State& base, const Eigen::Ref<const VectorX>& dq) const;
  void set_rates(State& state, const Eigen::Ref<const VectorX>& v, const Eigen::Ref<const VectorX>& a) const;
  void get_rates(const State& state, Eigen::Ref<VectorX> v, Eigen::Ref<VectorX> a) const;

  /// Computes r (size) of all equations. @param scale  if given, receives the largest contributions
  void residual(const State& state, const Environment& environment, Eigen::Ref<VectorX> r,
                ResidualScale* scale = nullptr) const;
  /// Computes the part of one member of the model in the residual.
  void residual_part(std::size_t member, const State& state, const Environment& environment,
                     Eigen::Ref<VectorX> r) const {
    residual_.set_part(member, state, environment, r);
  }
  /// Returns the pattern of the last tangent. `tangent` replaces it if bodies touch that were far apart when it was
  /// built; its values are always in the order of the pattern after the call. References to the pattern are then
  /// invalid.
  const SparsePattern& pattern() const { return tangent_.pattern()->whole; }
  /// Returns the pattern of the tangent, with the amplitudes that are condensed before a factorisation.
  const CondensedPattern& condensed_pattern() const { return tangent_.pattern()->condensed; }
  /// Both, for owners of values or factors in their order: the pattern was replaced if the pointer is another one.
  const std::shared_ptr<const TangentPattern>& shared_pattern() const { return tangent_.pattern(); }
  /// Removes the entries of bodies that were near to each other, so that later results do not depend on earlier states.
  void forget_pairs() const;
  /// Amplitudes of each component that couple only to its own unknowns, ascending.
  std::vector<std::vector<int>> lone_amplitudes() const { return tangent_.lone_amplitudes(); }
  /// Computes the values of the weighted tangent in the pattern's order.
  /// @param dq  increment since the base of the step, for T(Dq); nullptr: zero
  void tangent(const State& state, const Environment& environment, const TangentWeights& weights, const VectorX* dq,
               std::vector<double>& values) const;
  /// Computes first and second time derivatives of the constraint rows at the state's rates. Both vectors have one
  /// entry for each multiplier.
  void constraint_rates(const State& state, const Environment& environment, Eigen::Ref<VectorX> velocity,
                        Eigen::Ref<VectorX> acceleration) const;
  /// Sums the energies of the components, and the power of the supports that move nodes.
  Energy energy(const State& state, const Environment& environment) const;
  /// Times at which forces or prescribed motions have kinks, ascending, each once.
  std::vector<double> break_points() const;
  /// Ends a converged step: components update their memory; rotation matrices are made orthonormal again.
  /// @returns whether a component has left the branch on which the step was computed: the motion must then be restarted
  bool accept(State& state, const Environment& environment) const;

 private:
  void build_pattern();

  const Model& model_;
  NodeKinematics kinematics_;
  Unknowns unknowns_;
  SharedWork work_;
  ResidualAssembly residual_;
  mutable TangentAssembly tangent_;  ///< its pattern follows the states of the tangents
  mutable IdleConstraints idle_;     ///< contains places in this pattern
  Branches branches_;
};

}  // namespace bielle::mechanism
