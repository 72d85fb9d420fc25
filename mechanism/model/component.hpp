// The one interface: whatever adds to the equations of motion (element, joint, drive, load) is a Component.
//
// All components together make
//     r(q, v, a, lambda, y, ydot, t) = 0:   M a + g_internal - g_external + B^T lambda = 0,   Phi(q,t) = 0,   f(y,
//     ydot, q, v) = 0.
// A component sees its own nodes, second-order scalars ("amplitudes"), first-order unknowns and multipliers through a
// LocalState, and writes into local vectors and matrices of the layout
//     [ 6 per node: force (inertial), moment (node axes) | amplitudes | first-order rows | constraint rows ].
// Columns follow the same layout: dx (inertial) and dTheta (node axes, R exp(dTheta~)) of each node, and so on.
//
// A component may use what belongs to others (a gear the angles of two joints, friction the reaction of its joint, a
// valve the pressures of two volumes): it declares `references`, and the local layouts of those components follow its
// own, rows and columns (Slots). It may add forces to their nodes and flows to their first-order equations, never to
// their constraints. Constraints are affine in the multipliers of their owner, B^T lambda, and depend on those of no
// other: the derivative of a force by a multiplier of another component is a derivative of forces, no part of B.
// Whether a node is free, fixed, driven or carried rigidly by another is handled in system/: components need not know.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/model/local_tangent.hpp"
#include "mechanism/model/start_condition.hpp"
#include "mechanism/model/state.hpp"

namespace bielle::mechanism {

class Component;
class Description;
class Gatherer;
class Measure;
class MeasureGradient;
class MeshFields;

enum class ConstraintKind { holonomic, nonholonomic };  ///< Phi(q,t) = 0, or B(q) v + c(q,t) = 0

/// A function of the state whose zero begins another branch: contact, a force that is reached, an end of a range.
struct Crossing {
  enum class Direction { rising, falling, both };
  std::string name;  ///< "gap closes"
  Direction direction = Direction::both;
  /// Forces, rates or constraints may change after it: the motion is restarted there. Otherwise it is only noted.
  bool restarts = true;
  bool stops = false;  ///< the run ends there
  /// The crossing tells that a part which holds by a force is overloaded: if several are so at once, the one that is
  /// farthest beyond (its value the most negative) lets go first, because the others may hold without it.
  bool one_by_one = false;
  /// It is located no nearer to the start of a step than this share of the step: positions are rounded, which is an
  /// error of rates and forces that grows as steps become shorter, and may make other crossings look met. 0: as near as
  /// can be.
  double nearest = 0;
  /// The side on which every motion begins, +1 or -1: one that begins on the other side has crossed. 0: either.
  int begins_on = 0;
  /// Its value reads reactions (LocalState::reaction), which are made those of smallest norm before it is computed.
  bool reads_reaction = false;
};

/// Collects what a component needs. Names come back in messages and results: "moment z of joint 'main'".
struct Declaration {
  struct Scalar {
    std::string name;   ///< e.g. "mode 3"
    std::string units;  ///< of the unknown (amplitudes: of the modal amplitude; multipliers: "N" or "N m")
    double start = 0;   ///< initial value
    ConstraintKind kind = ConstraintKind::holonomic;  ///< multipliers only
    /// A typical size of the unknown, in its units: what is much smaller does not matter. 0: not known; it is then
    /// judged by the sizes of all unknowns of its kind.
    double scale = 0;
    std::string equation_units = {};  ///< of its equation; empty: as System::equation_units says
    /// First-order unknowns only: its equation 0 = f(y, q, v, t) holds no rate of it, and no other equation does
    /// (a junction without volume). Its start value is only where the search for one begins; its rate in the state is
    /// zero.
    bool algebraic = false;
    /// First-order unknowns only: where a static analysis does not determine it by a rate of zero (an integral that
    /// nothing depends on), it stays where it is. Its component, and what adds to its equation, see to that by
    /// LocalState::held: its row then holds its own increment alone.
    bool holdable = false;
    /// Multipliers only: the constraint may be switched off and on during a run, see Component::is_on.
    bool switched = false;
    /// Multipliers only: where the constraint and others repeat each other it is set aside, not they.
    bool yields = false;
  };
  std::vector<int> nodes;  ///< indices into the model's nodes
  std::vector<Scalar> amplitudes, first_order, multipliers;
  std::vector<double> memory;  ///< initial values
  /// Components whose unknowns, memory or measures this one uses, each once.
  std::vector<const Component*> references;
  /// Functions of the state whose zeros end steps, see Component::calc_crossings.
  std::vector<Crossing> crossings;
  /// The forces depend on the reactions of a component referred to (LocalState::reaction).
  bool reads_reactions = false;
  /// The forces have kinks in the state that end no step: a tangent from one side of a kink may be wrong on the other.
  bool kinks = false;
  /// Which of the tangent's three matrices the component contributes to.
  bool stiffness = false, damping = false, mass = false;
  /// The component adds to its tangent by blocks alone, each once, and never asks for a dense matrix (LocalMatrix).
  bool in_blocks = false;
  /// Start values of first-order unknowns follow from the state, see Component::add_start_values.
  bool starts_by_state = false;
  bool passive = false;  ///< it adds nothing to the equations (a measure)
};

/// Energies [J] and powers [W] of a component at a state.
struct Energy {
  double kinetic = 0, elastic = 0;
  double gravity = 0;      ///< potential; zero where the mass is in the inertial origin's level
  double dissipation = 0;  ///< power lost, >= 0
  double input = 0;        ///< power that drives and loads put in
  Energy& operator+=(const Energy& other) {
    kinetic += other.kinetic;
    elastic += other.elastic;
    gravity += other.gravity;
    dissipation += other.dissipation;
    input += other.input;
    return *this;
  }
};

/// One quantity of the results file.
struct OutputField {
  std::string name;                ///< dataset name, e.g. "strain"
  std::vector<std::size_t> shape;  ///< of one row; {} for a number
  std::string units;
  std::string description;
  bool summed = false;  ///< several components of a group may record it; their values are added up
  std::size_t size() const {
    std::size_t n = 1;
    for (std::size_t s : shape) n *= s;
    return n;
  }
};

/// See the head of this file. Const after construction: state lives in State, what must be remembered from step to step
/// in its `memory`.
class Component {
 public:
  Component(std::string type, std::string name) : type_(std::move(type)), name_(std::move(name)) {}
  virtual ~Component() = default;
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;
  const std::string& type() const { return type_; }  ///< as in the input file: "hinge"
  const std::string& name() const { return name_; }  ///< as in the input file: "main"

  virtual void declare(Declaration& declaration) const = 0;

  /// Adds the residual r at the state: inertia + internal - external forces, B^T lambda, and constraint rows Phi (for a
  /// non-holonomic row B v + c).
  virtual void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const = 0;

  /// Adds the derivatives of the residual. A component of few blocks that are each written once (joints, rigid bodies)
  /// declares `in_blocks` and writes blocks alone: where nothing stands between, they go straight to their places in
  /// the tangent of the whole, which takes half the time. Components that gather their entries from many points add to
  /// the dense matrices, `tangent.K.dense()`. Components that declare none of stiffness, damping, mass and multipliers
  /// are not asked.
  virtual void add_tangent(const LocalState& state, LocalTangent& tangent) const;

  /// Which entries of K, C and M can differ from zero; all, unless a component says that they are fewer. Other
  /// entries are ignored. Factorisations become faster.
  virtual void add_pattern(const Slots& /*slots*/, LocalPattern& pattern) const { pattern.add_all(); }

  /// Adds the first and second total time derivatives of this component's constraint rows along (v, a, t): for a
  /// holonomic row `velocity` = dPhi/dt and `acceleration` = d2Phi/dt2; for a non-holonomic one B v + c and its rate.
  /// Vectors of length `multipliers`. Components with multipliers must implement it.
  virtual void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                    Eigen::Ref<VectorX> acceleration) const;

  /// How fast the directions of its constraints turn at most [rad/s]: as the fastest of its nodes, unless a component
  /// says otherwise (a rod between two points turns with the line between them).
  virtual double turning_rate(const LocalState& state) const;

  /// When an analysis begins, with positions and velocities known, a component adds the changes that the start values
  /// of first-order unknowns need, its own or those of components that it refers to (a filter begins at its input). It
  /// is asked again until nothing changes. A motion goes on with the values of the one before: the component's memory
  /// has to tell what has begun. In a static analysis the search begins at these values.
  /// @param change  of the component's local layout
  virtual void add_start_values(const LocalState& /*state*/, Eigen::Ref<VectorX> /*change*/) const {}

  /// What is wrong with an assembled position although its constraint rows vanish (axes that point in opposite
  /// directions): a clause, or nothing.
  virtual std::string wrong_branch(const LocalState& /*state*/) const { return {}; }
  /// How its second node would have to turn relative to its first for the directions that its constraints compare to
  /// fit: the smallest rotation vector (inertial components), up to half a turn [rad]. Zero where it compares none.
  virtual Vector3 misalignment(const LocalState& /*state*/) const { return Vector3::Zero(); }

  virtual void add_energy(const LocalState& /*state*/, Energy& /*energy*/) const {}

  /// The quantities that the component can record, and their values one after the other in the same order.
  virtual std::vector<OutputField> output_fields() const { return {}; }
  virtual void write_output(const LocalState& /*state*/, double* /*values*/) const {}
  /// Quantities of the component's mesh. @returns nullptr if it has none
  virtual MeshFields* mesh_fields() { return nullptr; }
  const MeshFields* mesh_fields() const { return const_cast<Component*>(this)->mesh_fields(); }
  /// What keeps account of something over all steps of an analysis, if anything has to. @returns nullptr when not.
  /// The component must outlive it
  virtual std::unique_ptr<Gatherer> make_gatherer() const;
  /// Facts for readers of the results (e.g. {"file", "conrod.h5"}), written as attributes of the group.
  virtual std::vector<std::pair<std::string, std::string>> attributes() const { return {}; }

  /// What the component is, in the user's terms, for those who check a model: what they gave, and what became of it
  /// (mass, stiffness, frames). Components that are made of one entry describe it one after the other.
  /// @param state  of the assembled mechanism
  virtual void describe(const LocalState& /*state*/, Description& /*description*/) const {}

  /// After a converged step: new values of the component's memory, from the state (whose memory is still the old one).
  virtual void accept(const LocalState& /*state*/, Eigen::Ref<VectorX> /*memory*/) const {}

  /// Values of the declared crossings at a state (crossings). Each should be smooth on either side of its zero.
  virtual void calc_crossings(const LocalState& /*state*/, Eigen::Ref<VectorX> /*values*/) const {}

  /// Where a motion begins, and after every discontinuity (a crossing that restarts, a break point, an accepted step
  /// that asked for it): new values of the component's memory at the state just after it, whose rates may still be
  /// those before it.
  /// @param crossed  the component's own crossings that were met there, by number
  virtual void begin_branch(const LocalState& /*state*/, std::span<const int> /*crossed*/,
                            Eigen::Ref<VectorX> /*memory*/) const {}

  /// Whether what a state from outside (a file, a user) remembers of this component can be its memory: what it counts
  /// and points to is there. Its numbers are finite, but for those that begin as none.
  virtual bool knows_memory(const LocalState& /*state*/) const { return true; }

  /// Where a motion or a static analysis begins: new values of the component's memory as far as it follows from rates.
  /// Before rates are consistent nothing is `known` of them, and what would hold by them lets go; called again with the
  /// rates that a motion begins with.
  virtual void begin_motion(const LocalState& /*state*/, bool /*known*/, Eigen::Ref<VectorX> /*memory*/) const {}

  /// Whether the motion continues from the end of an accepted step on another branch than that of the step, although no
  /// crossing was detected: the motion is then restarted there.
  virtual bool leaves_branch(const LocalState& /*state*/) const { return false; }

  /// Adds the component's part of the norm of reactions, a quadratic form of its own multipliers: the square of the
  /// force [N^2], and of the moment over the arm. Where reactions are not unique, the smallest are reported. Default:
  /// each multiplier separately, as a moment where it is declared in N m.
  /// @param H  (multipliers, multipliers)
  virtual void add_reaction_norm(const LocalState& state, double arm, Eigen::Ref<MatrixX> H) const;

  /// What formulas may use of the component: "angle", "angle.rate", "reaction.x".
  virtual std::vector<std::string> measure_names() const { return {}; }
  /// One of them. @param name  as in the formula: "main.angle" @param measure  one of measure_names
  virtual std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const;

  /// Coordinates by which the start of a motion can be described.
  virtual std::vector<StartCoordinate> start_coordinates() const { return {}; }
  /// One of them, with gradients of its value by positions and of its rate by velocities over the local layout.
  /// @param gradient  is prepared here
  virtual StartCoordinateValue calc_start_coordinate(std::size_t index, const LocalState& state,
                                                     MeasureGradient& gradient) const;

  /// What the user may not have meant, although nothing is wrong with it: a clause for summaries, or nothing.
  virtual std::string remark() const { return {}; }

  /// Whether a switched constraint row is in the equations, by the component's memory.
  virtual bool is_on(const LocalState& /*state*/, int /*row*/) const { return true; }

  /// Times at which the component's forces or prescribed motions have kinks: steps end there.
  virtual void add_break_points(std::vector<double>& /*times*/) const {}

 private:
  std::string type_, name_;
};

}  // namespace bielle::mechanism
