// The state of a mechanism: nodes on R^3 x SO(3), and scalar unknowns.
#pragma once

#include <vector>

#include "mechanism/math/types.hpp"

namespace bielle::mechanism {

/// A node: position and translational rates are inertial components, rotational rates are body components
/// (dR/dt = R Omega~).
struct NodeState {
  Vector3 x = Vector3::Zero();         ///< position [m]
  Matrix3 R = Matrix3::Identity();     ///< node axes -> inertial axes
  Vector3 v = Vector3::Zero();         ///< velocity [m/s]
  Vector3 Omega = Vector3::Zero();     ///< angular velocity [rad/s], node axes
  Vector3 a = Vector3::Zero();         ///< acceleration [m/s^2]
  Vector3 Omegadot = Vector3::Zero();  ///< angular acceleration [rad/s^2], node axes
};

/// Positions and rates of all nodes, and all scalar unknowns. Restarts, results and components read the state; only
/// system/ and solvers/ write it.
struct State {
  double time = 0;  ///< [s]
  /// Fraction of the prescribed motions (of nodes, and of joints by drives) that is applied: 1 except within a static
  /// analysis.
  double motion_factor = 1;
  std::vector<NodeState> nodes;
  VectorX amplitude, amplitude_rate, amplitude_acceleration;  ///< second-order scalars (modes of superelements)
  VectorX first_order, first_order_rate;                      ///< first-order unknowns y (pressures)
  VectorX multiplier;                                         ///< multipliers lambda: constraint forces
  VectorX memory;  ///< values that components keep from the last accepted step (turns of an angle, bristles)
  /// For each multiplier, whether its constraint is out of the equations (redundant, or switched off). Its multiplier
  /// is zero. Empty: no constraint is.
  std::vector<char> idle;
  /// For each first-order unknown, whether it keeps its value in a static analysis because a rate of zero does not
  /// determine it; its equation is then out of the equations. Only a static analysis sets it. Empty: no unknown is
  /// held.
  std::vector<char> held;
  /// The multipliers of the reactions of smallest norm if redundancy leaves the multipliers undetermined
  /// (solvers/constraints/reaction_norm.hpp). Empty: `multiplier` itself.
  VectorX reaction;
};

/// Conditions that act on all components.
struct Environment {
  Vector3 gravity = Vector3::Zero();  ///< gravity [m/s^2], inertial, already multiplied by the load factor
  double load_factor = 1;             ///< factor on loads and forces of drives: 1 except in a static analysis
  bool statics = false;               ///< the load factor takes the place of time, in messages as well
  /// Newton's method at rest: the iterate from which one linear step led to the present state; otherwise nullptr. A
  /// stiffness that depends on stress may use the stress predicted by the step instead of the present one. At the
  /// solution both are the same; far from it the present stress has errors of second order, which stiff directions
  /// magnify (D. Magisano, L. Leonetti, G. Garcea, CMAME 313 (2017) 986).
  const State* before = nullptr;
};

/// Indices of a component's unknowns in the State. Nodes may repeat; the scalars are contiguous.
///
/// A component that refers to others sees their unknowns as well: its local vectors are
///     [ 6 per own node (dx, dTheta) | own amplitudes | own first-order | own multipliers | the whole local vector of
///       the first component that it refers to | of the second | ... ]
struct Slots {
  std::vector<int> nodes;
  int amplitude_begin = 0, amplitudes = 0;
  int first_order_begin = 0, first_orders = 0;
  int multiplier_begin = 0, multipliers = 0;
  int memory_begin = 0, memories = 0;
  /// Whether constraint rows must be formulated along axes that are attached to the component's nodes. This is required
  /// for rows that may be set aside as redundant: the redundant constraint of a planar linkage is normal to its plane,
  /// also when that plane turns. Otherwise a component may choose its axes (its forces are the same).
  bool carried_axes = true;
  std::vector<const Slots*> references;  ///< slots of the components that this one refers to, in the declared order
  std::vector<int> reference_rows;       ///< first local row of each reference
  int referenced = 0;                    ///< number of local rows of all references
  /// Size of the component's local vector.
  int size() const { return own_size() + referenced; }
  int own_size() const { return multiplier_row() + multipliers; }
  int amplitude_row() const { return 6 * static_cast<int>(nodes.size()); }
  int first_order_row() const { return amplitude_row() + amplitudes; }
  int multiplier_row() const { return first_order_row() + first_orders; }
  int reference_row(int k) const { return reference_rows[static_cast<std::size_t>(k)]; }
  /// Appends the slots of another component that this one refers to. The other's slots must be complete and must not
  /// move.
  void refer_to(const Slots& other) {
    references.push_back(&other);
    reference_rows.push_back(size());
    referenced += other.size();
  }
};

/// The part of a state that one component sees. It is a view: cheap, created where needed; the state must outlive it.
class LocalState {
 public:
  using Segment = Eigen::Map<const VectorX>;
  LocalState(const State& state, const Slots& slots, const Environment& environment)
      : state_(state), slots_(slots), environment_(environment) {}
  const State& global() const { return state_; }
  double time() const { return state_.time; }
  double motion_factor() const { return state_.motion_factor; }
  const Environment& environment() const { return environment_; }
  const Slots& slots() const { return slots_; }
  const NodeState& node(int k) const {
    return state_.nodes[static_cast<std::size_t>(slots_.nodes[static_cast<std::size_t>(k)])];
  }
  Segment amplitude() const { return {state_.amplitude.data() + slots_.amplitude_begin, slots_.amplitudes}; }
  Segment amplitude_rate() const { return {state_.amplitude_rate.data() + slots_.amplitude_begin, slots_.amplitudes}; }
  Segment amplitude_acceleration() const {
    return {state_.amplitude_acceleration.data() + slots_.amplitude_begin, slots_.amplitudes};
  }
  Segment first_order() const { return {state_.first_order.data() + slots_.first_order_begin, slots_.first_orders}; }
  Segment first_order_rate() const {
    return {state_.first_order_rate.data() + slots_.first_order_begin, slots_.first_orders};
  }
  Segment multiplier() const { return {state_.multiplier.data() + slots_.multiplier_begin, slots_.multipliers}; }
  /// Returns the multipliers as reported and as read by forces: those of the reactions of smallest norm if redundancy
  /// leaves them undetermined.
  Segment reaction() const {
    const VectorX& reported = state_.reaction.size() > 0 ? state_.reaction : state_.multiplier;
    return {reported.data() + slots_.multiplier_begin, slots_.multipliers};
  }
  /// Returns whether the k-th own constraint is out of the equations.
  bool idle(int k) const {
    return !state_.idle.empty() && state_.idle[static_cast<std::size_t>(slots_.multiplier_begin + k)] != 0;
  }
  /// Returns whether the k-th own first-order unknown keeps its value, in a static analysis that does not determine it.
  bool held(int k) const {
    return environment_.statics && !state_.held.empty() &&
           state_.held[static_cast<std::size_t>(slots_.first_order_begin + k)] != 0;
  }
  /// Local state of the k-th component that this one refers to.
  LocalState of(int k) const { return {state_, *slots_.references[static_cast<std::size_t>(k)], environment_}; }
  Segment memory() const { return {state_.memory.data() + slots_.memory_begin, slots_.memories}; }

 private:
  const State& state_;
  const Slots& slots_;
  const Environment& environment_;
};

/// Velocities of all unknowns of a local state, in its layout: zero for first-order unknowns and multipliers.
/// @param v  (slots().size())
void get_local_velocities(const LocalState& state, Eigen::Ref<VectorX> v);
/// Accelerations of all unknowns of a local state, in the same layout.
void get_local_accelerations(const LocalState& state, Eigen::Ref<VectorX> a);

}  // namespace bielle::mechanism
