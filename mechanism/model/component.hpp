// Interface of everything that adds to the equations of motion: each element, joint, drive and load is a Component.
//
// All components together make
//     r(q, v, a, lambda, y, ydot, t) = 0:   M a + g_internal - g_external + B^T lambda = 0,   Phi(q,t) = 0,   f(y,
//     ydot, q, v) = 0.
// A component sees its own nodes, second-order scalars ("amplitudes"), first-order unknowns and multipliers through a
// LocalState, and writes into local vectors and matrices of the layout
//     [ 6 per node: force (inertial), moment (node axes) | amplitudes | first-order rows | constraint rows ].
// Columns follow the same layout: dx (inertial) and dTheta (node axes, R exp(dTheta~)) of each node, and so on.
//
// A component may use unknowns of other components (a gear the angles of two joints, friction the reaction of its
// joint, a valve the pressures of two volumes): it declares `references`, and the local layouts of those components
// follow its own, rows and columns (Slots). It may add forces to their nodes and flows to their first-order equations,
// never to their constraints. Constraints are affine in the multipliers of their owner, B^T lambda, and do not depend
// on the multipliers of other components: the derivative of a force by a multiplier of another component is a
// derivative of forces, no part of B. Whether a node is free, fixed, driven or carried rigidly by another is handled in
// system/: components need not know.
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
class Drawing;
class StepRecorder;
class Measure;
class MeasureGradient;
class MeshFields;

enum class ConstraintKind { holonomic, nonholonomic };  ///< Phi(q,t) = 0, or B(q) v + c(q,t) = 0

/// An event function: its zero begins another branch of the motion (contact, a force limit, an end of a range).
struct EventFunction {
  enum class Direction { rising, falling, both };
  std::string name;  ///< "gap closes"
  Direction direction = Direction::both;
  /// Forces, rates or constraints may change at the event: the motion is restarted there. Otherwise the event is only
  /// recorded.
  bool restarts = true;
  bool stops = false;  ///< the run ends at the event
  /// The event tells that a part which holds by a force is overloaded. If several parts are overloaded at once, the one
  /// that is farthest beyond its limit (its value is the most negative) is released first, because the others may hold
  /// without it.
  bool one_by_one = false;
  /// The component's first constraint is one-sided, and the function is positive if its force has the wrong sign
  /// (`opens`), or if it is set aside as redundant and its coordinate moves against it (`violated`): it must then take
  /// the place of another one (solvers/start/one_sided_holds.hpp).
  enum class OneSided { no, opens, violated };
  OneSided one_sided = OneSided::no;
  /// The event is located no nearer to the start of a step than this fraction of the step: positions are rounded, and
  /// the error of rates and forces that follows grows as steps become shorter, so that other events may seem to occur.
  /// 0: as near as possible.
  double nearest = 0;
  /// The sign of the function at the start of every motion, +1 or -1: a motion that begins with the other sign has
  /// crossed zero. 0: either sign.
  int begins_on = 0;
  /// Its value reads reactions (LocalState::reaction): the reactions of smallest norm are computed before it.
  bool reads_reaction = false;
};

/// Collects what a component needs. The names appear in messages and results: "moment z of joint 'main'".
struct Declaration {
  struct Scalar {
    std::string name;   ///< e.g. "mode 3"
    std::string units;  ///< units of the unknown (modal amplitudes have their own, multipliers "N" or "N m")
    double start = 0;   ///< initial value
    ConstraintKind kind = ConstraintKind::holonomic;  ///< kind of the constraint (multipliers only)
    /// A typical size of the unknown, in its units: much smaller values do not matter. 0: not known; the sizes of all
    /// unknowns of its kind are then used instead.
    double scale = 0;
    std::string equation_units = {};  ///< units of its equation; empty: see System::equation_units
    /// First-order unknowns only: its equation 0 = f(y, q, v, t) does not contain its rate, and neither does any other
    /// equation (a junction without volume). Its start value is only the initial guess for the solution; its rate in
    /// the state is zero.
    bool algebraic = false;
    /// First-order unknowns only: the unknown keeps its value in a static analysis if a rate of zero does not determine
    /// it (an integral that nothing depends on). Its component, and every component that adds to its equation, must
    /// then check LocalState::held: the row then contains only the unknown's own increment.
    bool holdable = false;
    /// Multipliers only: the constraint may be switched off and on during a run, see Component::is_on.
    bool switched = false;
    /// Multipliers only: if the constraint and others are redundant, this constraint is set aside, not the others.
    bool yields = false;
  };
  std::vector<int> nodes;  ///< indices into the model's nodes
  std::vector<Scalar> amplitudes, first_order, multipliers;
  std::vector<double> memory;  ///< initial values
  /// Components whose unknowns, memory or measures this component uses, each once.
  std::vector<const Component*> references;
  /// Event functions whose zeros end steps, see Component::calc_event_functions.
  std::vector<EventFunction> event_functions;
  /// The forces depend on the reactions of a component referred to (LocalState::reaction).
  bool reads_reactions = false;
  /// The forces have kinks in the state at which no step ends: a tangent from one side of a kink may be wrong on the
  /// other.
  bool kinks = false;
  /// The matrices of the tangent that the component contributes to.
  bool stiffness = false, damping = false, mass = false;
  /// The component adds to its tangent by blocks only, each once, and never requests a dense matrix (LocalMatrix).
  bool in_blocks = false;
  /// Start values of first-order unknowns follow from the state, see Component::add_start_values.
  bool starts_by_state = false;
  bool passive = false;  ///< the component adds nothing to the equations (a measure)
};

/// Energies [J] and powers [W] of a component at a state.
struct Energy {
  double kinetic = 0, elastic = 0;
  double gravity = 0;      ///< potential energy; zero if the mass is at the level of the inertial origin
  double dissipation = 0;  ///< dissipated power, >= 0
  double input = 0;        ///< power supplied by drives and loads
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
  std::vector<std::size_t> shape;  ///< shape of one row; {} for a number
  std::string units;
  std::string description;
  bool summed = false;  ///< several components of a group may record it; their values are added up
  std::size_t size() const {
    std::size_t n = 1;
    for (std::size_t s : shape) n *= s;
    return n;
  }
};

/// See the head of this file. A component is const after construction: its state is part of State, and values that it
/// keeps from step to step are in its `memory`.
class Component {
 public:
  Component(std::string type, std::string name) : type_(std::move(type)), name_(std::move(name)) {}
  virtual ~Component() = default;
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;
  const std::string& type() const { return type_; }  ///< type as in the input file: "hinge"
  const std::string& name() const { return name_; }  ///< name as in the input file: "main"

  // The following functions form the equations.

  virtual void declare(Declaration& declaration) const = 0;

  /// Adds the residual r at the state: inertia + internal - external forces, B^T lambda, and constraint rows Phi (for a
  /// non-holonomic row B v + c).
  virtual void add_residual(const LocalState& state, Eigen::Ref<VectorX> r) const = 0;

  /// Adds the derivatives of the residual. A component of few blocks that are each written once (joints, rigid bodies)
  /// declares `in_blocks` and writes only blocks: they are added directly to the global tangent if no reduction is
  /// necessary, which takes half the time. Components that gather their entries from many points add to the dense
  /// matrices, `tangent.K.dense()`. This function is not called for components that declare none of stiffness, damping,
  /// mass and multipliers.
  virtual void add_tangent(const LocalState& state, LocalTangent& tangent) const;

  /// Declares which entries of K, C and M can differ from zero; by default all. Other entries are ignored. Fewer
  /// entries make factorisations faster.
  virtual void add_pattern(const Slots& /*slots*/, LocalPattern& pattern) const { pattern.add_all(); }

  /// Adds the first and second total time derivatives of this component's constraint rows along (v, a, t): for a
  /// holonomic row `velocity` = dPhi/dt and `acceleration` = d2Phi/dt2; for a non-holonomic one B v + c and its rate.
  /// Vectors of length `multipliers`. Components with multipliers must implement it.
  virtual void add_constraint_rates(const LocalState& state, Eigen::Ref<VectorX> velocity,
                                    Eigen::Ref<VectorX> acceleration) const;

  /// Returns whether a switched constraint row is in the equations, according to the component's memory.
  virtual bool is_on(const LocalState& /*state*/, int /*row*/) const { return true; }

  /// Upper bound on the angular velocity of the directions of its constraints [rad/s]: by default that of the fastest
  /// of its nodes; a component may override it (a rod between two points turns with the line between them).
  virtual double turning_rate(const LocalState& state) const;

  /// Adds the component's part of the norm of reactions, a quadratic form of its own multipliers: the square of the
  /// force [N^2], and of the moment divided by the arm. If reactions are not unique, those of smallest norm are
  /// reported. By default each multiplier is taken separately, as a moment if it is declared in N m.
  /// @param H  matrix of the quadratic form (multipliers, multipliers)
  virtual void add_reaction_norm(const LocalState& state, double arm, Eigen::Ref<MatrixX> H) const;

  // The following functions begin a motion, keep the memory from step to step, and find events.

  /// Adds the changes that the start values of first-order unknowns need, its own or those of components that it refers
  /// to (a filter begins at its input). The function is called at the beginning of an analysis, with positions and
  /// velocities known. The function is called again until nothing changes. A motion that follows another continues with
  /// its values: the component's memory has to tell whether they have been initialised. A static analysis takes these
  /// values as its initial guess.
  /// @param change  change of the start values, in the component's local layout
  virtual void add_start_values(const LocalState& /*state*/, Eigen::Ref<VectorX> /*change*/) const {}

  /// Computes new values of the component's memory at the beginning of a motion or a static analysis, as far as they
  /// follow from rates. Before rates are consistent, `known` is false: parts that hold depending on their rates are
  /// released. The function is called again with the rates at which the motion begins.
  virtual void begin_motion(const LocalState& /*state*/, bool /*known*/, Eigen::Ref<VectorX> /*memory*/) const {}

  /// Computes new values of the component's memory at the start of a motion and after every discontinuity (an event
  /// that restarts, a break point, an accepted step that requests it). The state is the one just after it; its rates
  /// may still be those before it.
  /// @param crossed  numbers of the component's own event functions that crossed zero there
  virtual void begin_branch(const LocalState& /*state*/, std::span<const int> /*crossed*/,
                            Eigen::Ref<VectorX> /*memory*/) const {}

  /// Values of the declared event functions at a state. Each should be smooth on either side of its zero.
  virtual void calc_event_functions(const LocalState& /*state*/, Eigen::Ref<VectorX> /*values*/) const {}

  /// Computes new values of the component's memory after a converged step, from the state (whose memory is still the
  /// old one).
  virtual void accept(const LocalState& /*state*/, Eigen::Ref<VectorX> /*memory*/) const {}

  /// Returns whether the motion continues after an accepted step on another branch than that of the step, although no
  /// event was detected: the motion is then restarted there.
  virtual bool leaves_branch(const LocalState& /*state*/) const { return false; }

  /// Computes new values of the component's memory when an event activates its entry, before `begin_branch`. The memory
  /// is that of the release. After the state has been made consistent, `accept` follows.
  virtual void activate(const LocalState& /*state*/, Eigen::Ref<VectorX> /*memory*/) const {}

  /// Returns whether the memory of a state from outside (a file, a user) is valid for this component: every number or
  /// index that it refers to exists. Its numbers are known to be finite, except those that have no initial value.
  virtual bool knows_memory(const LocalState& /*state*/) const { return true; }

  /// Adds the times at which the component's forces or prescribed motions have kinks: steps end there.
  virtual void add_break_points(std::vector<double>& /*times*/) const {}

  // The following functions give energies, results and measures.

  virtual void add_energy(const LocalState& /*state*/, Energy& /*energy*/) const {}

  /// Returns the quantities that the component can record, and their values one after the other in the same order.
  virtual std::vector<OutputField> output_fields() const { return {}; }
  virtual void write_output(const LocalState& /*state*/, double* /*values*/) const {}

  /// Attributes of the component's group in the results file (e.g. {"file", "conrod.h5"}).
  virtual std::vector<std::pair<std::string, std::string>> attributes() const { return {}; }

  /// Quantities of the component's mesh. @returns nullptr if it has none
  virtual MeshFields* mesh_fields() { return nullptr; }
  const MeshFields* mesh_fields() const { return const_cast<Component*>(this)->mesh_fields(); }

  /// Creates an object that gathers data over all steps of an analysis; the component must outlive it.
  /// @returns nullptr if the component needs none
  virtual std::unique_ptr<StepRecorder> make_step_recorder() const;

  /// Names of the measures that formulas may use: "angle", "angle.rate", "reaction.x".
  virtual std::vector<std::string> measure_names() const { return {}; }
  /// Creates one of these measures. @param name  as in the formula: "main.angle" @param measure  one of measure_names
  virtual std::unique_ptr<Measure> make_measure(const std::string& name, const std::string& measure) const;

  // The following functions describe the component to users.

  /// Describes the component in the user's terms, for users who check a model: the given data, and the resulting
  /// properties (mass, stiffness, frames). Components that are made of one entry describe it one after the other.
  /// @param state  state of the assembled mechanism
  virtual void describe(const LocalState& /*state*/, Description& /*description*/) const {}

  /// Adds the items by which the component is drawn. They depend on its given data alone, never on the state: they move
  /// with nodes. A component that cannot be seen adds none.
  virtual void draw(Drawing& /*drawing*/) const {}

  /// Returns a warning about an unusual but valid input: a clause for summaries, or empty.
  virtual std::string remark() const { return {}; }

 private:
  std::string type_, name_;
};

}  // namespace bielle::mechanism
