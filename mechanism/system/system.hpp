// A mechanism ready to compute: numbered unknowns, residual, weighted tangent, energies, and names for messages.
//
// Unknowns, in this order: independent increments of the nodes, amplitudes, first-order unknowns, multipliers.
// Equations likewise. "dofs" are the first two: what has inertia.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mechanism/math/sparse.hpp"
#include "mechanism/system/model.hpp"
#include "mechanism/system/node_kinematics.hpp"

namespace bielle::mechanism {

/// Kind of an unknown or equation: scales and tolerances go by it.
enum class Kind { translation, rotation, amplitude, first_order, multiplier };
inline constexpr std::size_t kind_count = 5;

/// Largest absolute contribution of any component to the equations of each kind: what a residual is small beside.
struct ResidualScale {
  std::array<double, kind_count> largest{};
  double& operator[](Kind kind) { return largest[static_cast<std::size_t>(kind)]; }
  double operator[](Kind kind) const { return largest[static_cast<std::size_t>(kind)]; }
};

/// The tangent is  stiffness * K T(Dq) + damping * C + mass * M  on dof columns, stiffness * K + first_order * C on
/// first-order columns; rows and columns of multipliers (B, B^T) carry the weight `constraint` in place of `stiffness`.
struct TangentWeights {
  double stiffness = 1, damping = 0, mass = 0, first_order = 0, constraint = 1;
  /// Rows of non-holonomic constraints hold their B (the part that multiplies velocities) alone: what relates
  /// accelerations. For the systems [M B^T; B 0] of a consistent start, and for statics.
  bool acceleration_level = false;
  /// Rows of holonomic constraints hold d(B v)/dq (weighted by `stiffness`) and B (weighted by `damping`) in place of
  /// B: the derivative of dPhi/dt. Other rows mean nothing then.
  bool velocity_level = false;
  /// Derivatives of forces by multipliers, df/dlambda, count in full whatever `stiffness` is; otherwise they have its
  /// weight. They stand in the columns of multipliers like B^T, but follow from forces, not from constraints.
  bool reactions = false;
};

/// A crossing that a member declares, see Component::calc_crossings.
struct MemberCrossing {
  std::size_t member;
  int index;  ///< among the member's own
  Crossing crossing;
  std::string name;  ///< with its owner: "joint 'door': angle at its upper stop"
};

/// Why a constraint is out of the equations (State::idle).
enum Idle : char { active = 0, switched_off = 1, redundant = 2 };

class System {
 public:
  /// Declares and numbers all components. Keeps a reference: the model must outlive the system.
  /// @throws InputError when components refer to each other in a circle
  explicit System(const Model& model);
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  const Model& model() const { return model_; }
  const NodeKinematics& kinematics() const { return kinematics_; }
  const std::vector<Slots>& slots() const { return slots_; }  ///< of the model's members, in their order

  int dofs() const { return kinematics_.unknowns() + amplitudes_; }
  int first_orders() const { return first_orders_; }
  int multipliers() const { return multipliers_; }
  int size() const { return dofs() + first_orders_ + multipliers_; }
  Kind kind(int unknown) const { return kinds_[static_cast<std::size_t>(unknown)]; }
  ConstraintKind constraint_kind(int multiplier) const {
    return constraint_kinds_[static_cast<std::size_t>(multiplier)];
  }
  /// Typical size of an unknown [its units], as its component declares it; 0: none is known.
  double scale(int unknown) const {
    return unknown < kinematics_.unknowns()
               ? 0
               : scalar_scales_[static_cast<std::size_t>(unknown - kinematics_.unknowns())];
  }
  /// First-order unknowns whose equations hold no rates of theirs, ascending, counted among the first-order ones.
  const std::vector<int>& algebraic() const { return algebraic_; }
  std::string unknown_name(int unknown) const;    ///< "rotation y of node 'pin'", "mode 3 of element 'rod'"
  std::string equation_name(int equation) const;  ///< "moment y at node 'pin'", "constraint x of joint 'main'"
  /// As declared. Otherwise N and N m of nodes; of amplitudes in m, rad and m kg^0.5: N, N m and N/sqrt(kg); of
  /// first-order unknowns their units per second, or as they are where the equation holds no rate; of constraints m or
  /// rad, of those that relate velocities m/s or rad/s.
  std::string equation_units(int equation) const;
  /// The first component whose position is on a wrong branch, with what is wrong: "joint 'main': its axes point in
  /// opposite directions"; or nothing.
  std::string wrong_branch(const State& state, const Environment& environment) const;

  /// Takes redundant constraints out of the equations: their multipliers stay zero. Components none of whose rows are
  /// among them may choose the axes of their rows from here on. Call before solvers are made.
  void set_aside(const std::vector<int>& multipliers);
  const std::vector<int>& set_aside() const { return set_aside_; }
  /// Calls act(multiplier) for each constraint that is out of the equations at a state, ascending.
  template <class Act>
  void for_each_idle(const State& state, const Act& act) const {
    if (state.idle.empty()) {
      for (const int multiplier : set_aside_) act(multiplier);
      return;
    }
    for (int multiplier = 0; multiplier < multipliers_; ++multiplier)
      if (state.idle[static_cast<std::size_t>(multiplier)] != Idle::active) act(multiplier);
  }
  /// Calls act(multiplier) for those of them that are redundant.
  template <class Act>
  void for_each_redundant(const State& state, const Act& act) const {
    for_each_idle(state, [&](int multiplier) {
      if (state.idle.empty() || state.idle[static_cast<std::size_t>(multiplier)] == Idle::redundant) act(multiplier);
    });
  }
  /// Whether constraints can be switched off and on during a run.
  bool switches() const { return !switched_.empty(); }
  /// Sets `idle` of the switched constraints from what components remember; the others count as active. Nothing where
  /// no constraint can be switched.
  void switch_constraints(State& state, const Environment& environment) const;
  /// Whether forces depend on reactions, or have kinks that end no step.
  bool reads_reactions() const { return reads_reactions_; }
  bool has_kinks() const { return kinks_; }

  const std::vector<MemberCrossing>& crossings() const { return crossings_; }
  /// Values of all crossings (crossings().size()).
  void calc_crossings(const State& state, const Environment& environment, Eigen::Ref<VectorX> values) const;
  /// Components renew what they remember where a branch of the motion begins. @param crossed  numbers of crossings
  void begin_branch(State& state, const Environment& environment, const std::vector<int>& crossed = {}) const;
  /// The member that a component is; the component must be of the model.
  std::size_t member_of(const Component& component) const { return member_index_.at(&component); }
  /// The slots of a component of the model.
  const Slots& slots_of(const Component& component) const { return slots_[member_of(component)]; }

  /// State of the input file at a time: positions and rates as given, start values of scalars, multipliers zero.
  State start(double time) const;
  /// state = base o exp(dq) at state.time, with the part state.motion_factor of prescribed motions. @param dq (dofs)
  void displace(State& state, const State& base, const Eigen::Ref<const VectorX>& dq) const;
  void set_rates(State& state, const Eigen::Ref<const VectorX>& v, const Eigen::Ref<const VectorX>& a) const;
  void get_rates(const State& state, Eigen::Ref<VectorX> v, Eigen::Ref<VectorX> a) const;

  /// r (size) of all equations. @param scale  if given, receives the largest contributions
  void residual(const State& state, const Environment& environment, Eigen::Ref<VectorX> r,
                ResidualScale* scale = nullptr) const;
  const SparsePattern& pattern() const { return pattern_; }
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
  /// A local entry and its place among the global values.
  struct Target {
    int entry, place;
  };
  /// Where local entries go: three neighbours that are neighbours there, too, and single ones.
  struct Targets {
    std::vector<Target> triples, singles;
    bool empty() const { return triples.empty() && singles.empty(); }
  };
  /// A node among a component's local unknowns: its own, or of a component that it refers to.
  struct NodePart {
    int node, local, reduced;  ///< first rows
  };
  /// Neighbouring scalars of one kind among them.
  struct ScalarPart {
    Kind kind;
    int local, reduced, count;  ///< first rows
    int unknown;                ///< first global unknown
    bool own;
  };
  /// How one component's local rows and columns reach the global ones.
  struct Placement {
    bool plain = true;         ///< every node is free in all six directions, or held in all: reduced rows are local ones
    std::vector<int> unknown;  ///< global unknown of each reduced local row, -1 where held
    Targets targets;           ///< of the reduced entries (column-major), without those that are dropped
    int own_size = 0;                 ///< local rows of its own
    int own_nodes_end = 0;            ///< local rows of its own nodes
    std::vector<NodePart> nodes;      ///< own ones first
    std::vector<ScalarPart> scalars;  ///< own ones first
    bool stiffness = false, damping = false, mass = false;
    bool reads_multipliers = false;  ///< of components that it refers to
    std::vector<int> nonholonomic;   ///< local rows
    bool in_blocks = false;          ///< blocks go straight to their places
    BlockPlaces places;              ///< of those
  };
  struct Workspace;
  static void scatter(const Targets& targets, const double* entries, std::vector<double>& values);
  void velocity_rows(const Placement& placement, const LocalState& local, const Component& component,
                     Workspace& work) const;
  void resolve_references(const std::vector<Declaration>& declarations);
  void add_parts(Placement& placement, const Slots& slots, int local, bool own) const;
  void take_units(const std::vector<Declaration>& declarations);
  void place(const std::vector<Declaration>& declarations);
  void find_idle_places();
  void weigh_stiffness(const Placement& placement, const Slots& slots, const TangentWeights& weights,
                       Eigen::Map<MatrixX>& K) const;
  void add_referenced(const Placement& placement, double* part, VectorX& forces, Eigen::Ref<VectorX> r,
                      ResidualScale& scale) const;
  LocalPattern reduced_pattern(std::size_t member) const;
  static Targets in_triples(const std::vector<Target>& targets);
  BlockPlaces block_places(const Slots& slots, const std::vector<Target>& targets) const;
  void build_pattern();
  void node_forces(const State& state, const Environment& environment, VectorX& forces, Eigen::Ref<VectorX> r,
                   ResidualScale* scale) const;
  void add_in_place(const Placement& placement, const LocalState& local, const TangentWeights& weights,
                    const Component& component, const Matrix3* turns, std::vector<double>& values) const;
  void add_reduced(const Placement& placement, const LocalState& local, const TangentWeights& weights,
                   const Component& component, const VectorX* dq, Workspace& work, std::vector<double>& values) const;
  void add_plain(const Placement& placement, const TangentWeights& weights, const VectorX* dq, bool with_K, bool with_C,
                 bool with_M, int n, Workspace& work) const;
  void add_related(const Placement& placement, const LocalState& local, const TangentWeights& weights,
                   const Component& component, const VectorX* dq, Workspace& work) const;

  const Model& model_;
  NodeKinematics kinematics_;
  std::vector<Slots> slots_;
  std::vector<Placement> placements_;
  std::vector<int> force_rows_;  ///< of the members' nodes, one member behind the other: NodeKinematics::force_row
  int amplitudes_ = 0, first_orders_ = 0, multipliers_ = 0, memories_ = 0, largest_local_ = 0;
  VectorX start_amplitude_, start_first_order_, start_multiplier_, start_memory_;
  std::vector<Kind> kinds_;
  std::vector<ConstraintKind> constraint_kinds_;
  std::vector<std::string> scalar_names_;  ///< of amplitudes, first-order unknowns, multipliers in global order
  std::vector<std::string> scalar_equation_units_;
  std::vector<double> scalar_scales_;
  std::vector<int> algebraic_;
  SparsePattern pattern_;
  std::map<const Component*, std::size_t> member_index_;
  std::vector<std::size_t> acting_;  ///< members that add to the equations
  std::vector<MemberCrossing> crossings_;
  bool reads_reactions_ = false, kinks_ = false;
  std::vector<int> set_aside_;  ///< multipliers
  /// Where a multiplier's row and column stand among the values, if it can be out of the equations.
  struct IdlePlaces {
    std::vector<int> entries;  ///< without the diagonal
    int diagonal = -1;
  };
  std::vector<IdlePlaces> idle_places_;  ///< of each multiplier
  /// A constraint that can be switched.
  struct Switched {
    std::size_t member;
    int row, multiplier;  ///< of the component, and among all
  };
  std::vector<Switched> switched_;
};

}  // namespace bielle::mechanism
