#include "mechanism/solvers/start/assemble_positions.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "mechanism/model/assembly_branch.hpp"
#include "mechanism/solvers/constraints/redundancy.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "mechanism/solvers/start/closing_newton.hpp"
#include "mechanism/solvers/start/unclosed.hpp"

namespace bielle::mechanism {
namespace {

/// Returns whether all conditions are satisfied initially. This is the most frequent case, and is checked without a
/// factorisation.
bool holds(const System& system, const Environment& environment, const State& state,
           const StartConditions& conditions) {
  constexpr double satisfied = 1e-13, repeated = 1e-6;  // limit for redundant constraints, as in check_set_aside()
  std::vector<bool> redundant(static_cast<std::size_t>(system.multipliers()), false);
  bool any_redundant = false;
  system.for_each_redundant(
      state, [&](int multiplier) { redundant[static_cast<std::size_t>(multiplier)] = any_redundant = true; });
  const State whole = any_redundant ? with_redundant(system, state) : State();
  const State& all = any_redundant ? whole : state;
  VectorX r(system.size());
  system.residual(all, environment, r);
  const int first = system.size() - system.multipliers();
  std::vector<bool> off(static_cast<std::size_t>(system.multipliers()), false);
  system.for_each_idle(all, [&](int multiplier) { off[static_cast<std::size_t>(multiplier)] = true; });
  std::optional<VectorX> sizes;
  for (int k = 0; k < system.multipliers(); ++k) {
    const auto row = static_cast<std::size_t>(k);
    if (r[first + k] == 0 || off[row] || system.constraint_kind(k) != ConstraintKind::holonomic) continue;
    if (!sizes) sizes = constraint_sizes(system, environment, all);
    if (!(std::abs(r[first + k]) <= (redundant[row] ? repeated : satisfied) * (*sizes)[k])) return false;
  }
  for (const CoordinateCondition& each : conditions.coordinates) {
    if (!each.value) continue;
    const StartCoordinate coordinate = start_coordinate(system, each);
    const double value = coordinate_row(system, environment, state, each.member, each.coordinate).value;
    const double size = coordinate.units == "m" ? model_length(state) : 1;
    if (!(std::abs(coordinate_distance(coordinate, value, *each.value)) <= satisfied * size)) return false;
  }
  return true;
}

/// Rotates parts of members whose directions are off by more than a quarter turn.
/// @returns the state with rotated parts; no value if there is none, or none can be rotated
std::optional<State> turned_right(const System& system, const Environment& environment, const State& drawn,
                                  const std::vector<int>& kept_nodes) {
  constexpr double quarter = M_PI / 2;
  VectorX dq = VectorX::Zero(system.dofs());
  bool any = false;
  for (std::size_t m = 0; m < system.slots().size(); ++m) {
    const Slots& slots = system.slots()[m];
    if (slots.multipliers == 0 || !system.is_active(drawn, m)) continue;
    const auto* branch = dynamic_cast<const AssemblyBranch*>(system.model().members()[m].component.get());
    if (!branch) continue;
    const Vector3 turn = branch->misalignment(LocalState(drawn, slots, environment));
    if (turn.norm() < quarter) continue;
    // The second node is rotated if it is free, otherwise the first one, in the opposite direction.
    for (const std::size_t k : {1U, 0U}) {
      const Carry* carry = system.kinematics().carry(slots.nodes[k]);
      const int root = carry ? carry->carrier : slots.nodes[k];
      const NodeFreedom& freedom = system.kinematics().freedom(root);
      const bool kept = std::any_of(kept_nodes.begin(), kept_nodes.end(), [&](int node) {
        const Carry* of_kept = system.kinematics().carry(node);
        return (of_kept ? of_kept->carrier : node) == root;
      });
      if (kept || !freedom.all_free || !dq.segment<3>(freedom.begin + 3).isZero(0)) continue;
      dq.segment<3>(freedom.begin + 3) =
          (k == 1 ? 1.0 : -1.0) * (drawn.nodes[static_cast<std::size_t>(root)].R.transpose() * turn);
      any = true;
      break;
    }
  }
  if (!any) return {};
  State state = drawn;
  system.displace(state, drawn, dq);
  return state;
}

class PositionAssembly {
 public:
  PositionAssembly(const System& system, const Environment& environment, const State& drawn,
                   const StartConditions& conditions)
      : system_(system), environment_(environment), drawn_(drawn), conditions_(conditions) {}

  State assembled() {
    State state = drawn_;
    bool closed = close(state);
    std::string wrong = closed ? system_.wrong_branch(state, environment_) : "";
    if (!closed || !wrong.empty()) {
      if (const std::optional<State> turned = turned_right(system_, environment_, drawn_, conditions_.kept_nodes)) {
        State other = *turned;
        if (close(other) && system_.wrong_branch(other, environment_).empty()) return other;
      }
    }
    if (closed && wrong.empty()) return state;
    if (closed)
      throw ComputationError(fmt::format(
          "the mechanism is put together the wrong way round; {}: draw it nearer to where it starts", wrong));
    throw ComputationError("the mechanism cannot be put together: " + why_);
  }

 private:
  /// Closes the gaps from a state. Nodes with given rates are held if possible; redundant constraints are included,
  /// unless they only seemed to be redundant.
  bool close(State& state) {
    const State from = state;
    std::string why;
    for (const TakingPart& who : {TakingPart{true, true}, TakingPart{false, true}, TakingPart{true, false}}) {
      ClosingEquations equations(system_, environment_, from, conditions_, who);
      if (!who.nonholonomic && !equations.any_nonholonomic()) continue;
      if (!who.set_aside && !any_set_aside()) continue;
      state = from;
      state.multiplier.setZero();
      if (close(equations, state, why) && (who.set_aside || repeated_hold(state))) {
        settle_idle(state);
        return true;
      }
    }
    if (why_.empty()) why_ = why;
    state = from;
    return false;
  }

  /// Tries to close the gaps from the state, from a perturbed one, and with bodies that initially have no stiffness.
  bool close(ClosingEquations& equations, State& state, std::string& why) const {
    const State from = state;
    std::optional<State> nearest;
    double least = 0;
    const auto closes = [&](State trial) {
      if (close_gaps(equations, trial)) {
        state = std::move(trial);
        return true;
      }
      const double open = equations.measure(trial).squared;
      if (!nearest || open < least) {
        least = open;
        nearest = std::move(trial);
      }
      return false;
    };
    if (closes(from) || closes(equations.shaken(from))) return true;
    if (equations.any_stiffness()) {
      equations.leave_stiffness_out(true);
      State near = from;
      const bool fits = close_gaps(equations, near);
      equations.leave_stiffness_out(false);
      if (fits && closes(near)) return true;
    }
    const Unclosed unclosed = explain_unclosed(equations, *nearest);
    if (unclosed.closes && closes(*nearest)) return true;
    if (why.empty())
      why =
          unclosed.closes ? "no positions were found in which everything fits; draw it nearer to them" : unclosed.text;
    return false;
  }

  /// Returns whether constraints that were set aside are satisfied.
  bool repeated_hold(State state) const {
    settle_idle(state);
    try {
      check_set_aside(system_, environment_, state);
    } catch (const ComputationError&) {
      return false;
    }
    return true;
  }

  bool any_set_aside() const {
    bool any = false;
    system_.for_each_redundant(drawn_, [&](int) { any = true; });
    return any;
  }

  void settle_idle(State& state) const {
    state.idle = drawn_.idle;
    state.multiplier = drawn_.multiplier;
    state.reaction = drawn_.reaction;
  }

  const System& system_;
  const Environment& environment_;
  const State& drawn_;
  const StartConditions& conditions_;
  std::string why_;
};

}  // namespace

void assemble_positions(const System& system, const Environment& environment, State& state, StartReport& report,
                        const StartConditions& conditions) {
  if (system.multipliers() == 0 && conditions.empty()) return;
  if (!holds(system, environment, state, conditions)) {
    const State drawn = state;
    state = PositionAssembly(system, environment, drawn, conditions).assembled();
    note_moved(system, environment, drawn, state, report);
    return;
  }
  if (const std::string wrong = system.wrong_branch(state, environment); !wrong.empty()) {
    const State drawn = state;
    if (const std::optional<State> turned = turned_right(system, environment, drawn, conditions.kept_nodes))
      state = PositionAssembly(system, environment, *turned, conditions).assembled();
    if (const std::string still = system.wrong_branch(state, environment); !still.empty())
      throw ComputationError(fmt::format(
          "the mechanism is put together the wrong way round; {}: draw it nearer to where it starts", still));
    note_moved(system, environment, drawn, state, report);
  }
}

}  // namespace bielle::mechanism
