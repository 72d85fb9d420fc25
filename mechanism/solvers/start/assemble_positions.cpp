#include "mechanism/solvers/start/assemble_positions.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/constraints/mass_saddle.hpp"
#include "mechanism/solvers/newton/model_length.hpp"

namespace bielle::mechanism {
namespace {

constexpr double satisfied = 1e-13;  // relative to the constraint's size
constexpr double relaxed = 1e-7;     // motion of the last iteration relative to the mechanism's size
constexpr double most_turn = 0.3;    // [rad] of a node per iteration
constexpr int most_iterations = 100;

class PositionAssembly {
 public:
  PositionAssembly(const System& system, const Environment& environment, State& state)
      : system_(system),
        environment_(environment),
        state_(state),
        sizes_(constraint_sizes(system, environment, state)),
        length_(model_length(state)),
        linear_(system),
        r_(system.size()),
        step_(system.size()),
        drawn_(system.size()),
        elastic_(system.size()) {
    unloaded_.load_factor = environment.load_factor;
    // Forces of elastic parts as they are drawn stay as they are; what the motion adds is relaxed.
    system.residual(unstressed(), unloaded_, drawn_);
  }

  void assemble() {
    double previous = 0, motion = 0;
    for (int iteration = 0;; ++iteration) {
      measure();
      const bool together =
          worst_ <= satisfied || (iteration > 0 && worst_ <= 1e3 * satisfied && worst_ >= 0.5 * previous);
      if (together && (iteration == 0 || motion <= relaxed || iteration == most_iterations)) return;
      if (iteration == most_iterations || !std::isfinite(worst_))
        throw ComputationError(fmt::format("the mechanism cannot be put together: {} stays violated by {:.3g} {}",
                                           system_.equation_name(worst_row_), r_[worst_row_],
                                           system_.equation_units(worst_row_)));
      previous = worst_;
      solve();
      motion = move();
    }
  }

 private:
  /// The state at rest, without reactions.
  State unstressed() const {
    State still = state_;
    still.multiplier.setZero();
    system_.set_rates(still, VectorX::Zero(system_.dofs()), VectorX::Zero(system_.dofs()));
    return still;
  }

  /// Violations, as the residual's last rows, and the worst of them relative to its constraint's size.
  void measure() {
    const int first = system_.size() - system_.multipliers();
    system_.residual(state_, environment_, r_);
    worst_ = 0;
    worst_row_ = -1;
    for (int i = 0; i < system_.multipliers(); ++i) {
      if (system_.constraint_kind(i) != ConstraintKind::holonomic) {
        r_[first + i] = 0;
        continue;
      }
      const double violation = std::abs(r_[first + i]) / sizes_[i];
      if (violation <= worst_ || std::isnan(worst_)) continue;
      worst_ = violation;
      worst_row_ = first + i;
    }
  }

  void solve() {
    const State still = unstressed();
    const TangentWeights weights{1, 0, 0, 1, 1, true};
    linear_.try_factor(still, unloaded_, weights, nullptr);
    // So little that parts as slender as 1e4 turn rather than bend.
    const VectorX extra = small_diagonal(system_, linear_, state_, 1e-10);
    if (!linear_.try_factor(still, unloaded_, weights, nullptr, &extra)) linear_.throw_singular(state_.time);
    system_.residual(still, unloaded_, elastic_);
    const int first = system_.size() - system_.multipliers();
    r_.head(first) = elastic_.head(first) - drawn_.head(first);
    linear_.solve(r_, step_);
  }

  /// Far from assembled, a full step may overshoot: no node turns by more than most_turn per iteration.
  /// @returns the full step's length: displacements relative to the mechanism's size, or [rad]
  double move() {
    double turn = 0, displacement = 0;
    for (int i = 0; i < system_.dofs(); ++i) {
      if (system_.kind(i) == Kind::rotation) turn = std::max(turn, std::abs(step_[i]));
      if (system_.kind(i) == Kind::translation) displacement = std::max(displacement, std::abs(step_[i]) / length_);
    }
    const double part = turn > most_turn ? most_turn / turn : 1;
    const State base = state_;
    system_.displace(state_, base, part * step_.head(system_.dofs()));
    for (const int k : system_.algebraic()) state_.first_order[k] += part * step_[system_.dofs() + k];
    return std::max(displacement, turn);
  }

  const System& system_;
  const Environment& environment_;
  Environment unloaded_;
  State& state_;
  VectorX sizes_;  ///< of the constraints
  double length_;
  LinearStep linear_;
  VectorX r_, step_, drawn_, elastic_;
  double worst_ = 0;
  int worst_row_ = -1;
};

}  // namespace

void assemble_positions(const System& system, const Environment& environment, State& state, StartReport& report) {
  if (system.multipliers() == 0) return;
  const State start = state;
  PositionAssembly(system, environment, state).assemble();
  if (const std::string wrong = system.wrong_branch(state, environment); !wrong.empty())
    throw ComputationError(
        fmt::format("the mechanism is put together the wrong way round; {}: draw it nearer to where it starts", wrong));
  note_farthest(system, start, state, report.largest_displacement, report.displaced_node);
  for (std::size_t i = 0; i < state.nodes.size(); ++i)
    report.largest_rotation =
        std::max(report.largest_rotation, log_so3(Matrix3(start.nodes[i].R.transpose() * state.nodes[i].R)).norm());
}

}  // namespace bielle::mechanism
