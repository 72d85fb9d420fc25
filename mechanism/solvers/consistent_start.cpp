#include "mechanism/solvers/consistent_start.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/massless_balance.hpp"
#include "mechanism/solvers/massless_direction.hpp"
#include "mechanism/solvers/model_length.hpp"
#include "mechanism/solvers/redundancy.hpp"

namespace bielle::mechanism {
namespace {

/// A fraction of the mean diagonal of each kind of dof. A kind without any takes it from the other by the model's
/// length: inertia = mass * length^2.
VectorX small_diagonal(const System& system, const LinearStep& linear, const State& state, double fraction) {
  std::array<double, kind_count> mean{}, count{};
  for (int i = 0; i < system.dofs(); ++i) {
    const auto kind = static_cast<std::size_t>(system.kind(i));
    mean[kind] += std::abs(linear.diagonal(i));
    count[kind] += 1;
  }
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    if (count[kind] > 0) mean[kind] /= count[kind];
  double &translation = mean[static_cast<std::size_t>(Kind::translation)],
         &rotation = mean[static_cast<std::size_t>(Kind::rotation)];
  const double area = model_length(state) * model_length(state);
  if (translation == 0) translation = rotation > 0 ? rotation / area : 1;
  if (rotation == 0) rotation = translation * area;
  VectorX diagonal(system.dofs());
  for (int i = 0; i < system.dofs(); ++i) {
    const double own = mean[static_cast<std::size_t>(system.kind(i))];
    diagonal[i] = fraction * (own > 0 ? own : 1.0);
  }
  return diagonal;
}

[[noreturn]] void throw_massless(const std::string& what, const char* lack) {
  throw ComputationError(fmt::format(
      "{}: it has no mass, and nothing holds it; hold it (`fixed`), join it, or give it a body with {}", what, lack));
}

/// Refuses motions of nodes that nothing but a sum of rows shows to have neither mass nor anything that holds them.
void check_massless_directions(const System& system, const State& state) {
  // At rest and without loads: what turns with a node that is loaded seems to hold it.
  State still = state;
  system.set_rates(still, VectorX::Zero(system.dofs()), VectorX::Zero(system.dofs()));
  Environment unloaded;
  unloaded.load_factor = 0;
  std::vector<double> mass, all;
  system.tangent(still, unloaded, {0, 0, 1, 0, 0}, nullptr, mass);
  for (int node = 0; node < static_cast<int>(system.model().nodes().size()); ++node) {
    const auto direction = massless_direction(system, mass, node);
    if (!direction) continue;
    if (all.empty()) system.tangent(still, unloaded, {1, 1, 1, 1, 1}, nullptr, all);
    const int begin = system.kinematics().freedom(node).begin;
    double left = 0, size = 0;
    for (int column = 0; column < system.size(); ++column) {
      double sum = 0;
      for (int k = 0; k < 6; ++k) {
        const int place = system.pattern().find(begin + k, column);
        if (place < 0) continue;
        const double term = (*direction)[k] * all[static_cast<std::size_t>(place)];
        sum += term;
        size = std::max(size, std::abs(term));
      }
      left = std::max(left, std::abs(sum));
    }
    constexpr double rounding = 1e-12;
    if (left <= rounding * size) throw_massless(massless_name(system, node, *direction), "inertia");
  }
}

}  // namespace

void StartReport::add(const StartReport& later) {
  if (later.largest_displacement > largest_displacement) {
    largest_displacement = later.largest_displacement;
    displaced_node = later.displaced_node;
  }
  largest_rotation = std::max(largest_rotation, later.largest_rotation);
  velocity_change = std::max(velocity_change, later.velocity_change);
  if (later.settled > settled) {
    settled = later.settled;
    settled_node = later.settled_node;
  }
  if (later.balanced > balanced) {
    balanced = later.balanced;
    balanced_node = later.balanced_node;
  }
  if (!later.unbalanced.empty()) unbalanced = later.unbalanced;
}

VectorX factor_mass_saddle(const System& system, const Environment& environment, const State& state,
                           LinearStep& linear) {
  const TangentWeights weights{0, 0, 1, 1, 1, true};
  const auto regular = [&](const VectorX* extra) {
    return linear.try_factor(state, environment, weights, nullptr, extra) && !linear.nearly_singular();
  };
  if (regular(nullptr)) return VectorX::Zero(system.dofs());
  // Any small mass gives the same multipliers to its own size. Masses that there are stay as they are, if that helps.
  constexpr double floor = 1e-12;
  const VectorX everywhere = small_diagonal(system, linear, state, floor);
  VectorX extra = everywhere;
  for (int i = 0; i < system.dofs(); ++i)
    if (linear.diagonal(i) > 0) extra[i] = 0;
  // A dof without mass, stiffness, damping and constraint has no equation at all.
  linear.try_factor(state, environment, TangentWeights{1, 1, 1, 1, 1}, nullptr);
  VectorX sums(system.size());
  linear.row_sums(VectorX::Ones(system.size()), sums);
  for (int i = 0; i < system.dofs(); ++i)
    if (sums[i] == 0) throw_massless(system.unknown_name(i), system.kind(i) == Kind::rotation ? "inertia" : "mass");
  if (linear.try_factor(state, environment, weights, nullptr, &extra)) return extra;
  if (!linear.try_factor(state, environment, weights, nullptr, &everywhere)) linear.throw_singular(state.time);
  return everywhere;
}

void note_farthest(const System& system, const State& from, const State& to, double& distance, std::string& node) {
  for (std::size_t i = 0; i < to.nodes.size(); ++i) {
    const double moved = (to.nodes[i].x - from.nodes[i].x).norm();
    if (moved <= distance) continue;
    distance = moved;
    node = system.model().node(static_cast<int>(i)).name;
  }
}

void assemble_positions(const System& system, const Environment& environment, State& state, StartReport& report) {
  if (system.multipliers() == 0) return;
  const int first = system.size() - system.multipliers();
  const VectorX sizes = constraint_sizes(system, environment, state);
  constexpr double satisfied = 1e-13;  // beside the constraint's size
  constexpr double relaxed = 1e-7;     // motion of the last iteration beside the mechanism's size
  constexpr double most_turn = 0.3;    // [rad] of a node per iteration
  constexpr int iterations = 100;
  LinearStep linear(system);
  VectorX r(system.size()), step(system.size());
  const State start = state;
  const double length = model_length(state);
  // Forces of elastic parts as they are drawn stay as they are; what the motion adds is relaxed.
  Environment unloaded;
  unloaded.load_factor = environment.load_factor;
  const auto unstressed = [&](const State& stressed) {
    State still = stressed;
    still.multiplier.setZero();
    system.set_rates(still, VectorX::Zero(system.dofs()), VectorX::Zero(system.dofs()));
    return still;
  };
  VectorX drawn(system.size()), elastic(system.size());
  system.residual(unstressed(state), unloaded, drawn);
  double previous = 0, motion = 0;
  for (int iteration = 0;; ++iteration) {
    system.residual(state, environment, r);
    double worst = 0;
    int worst_row = -1;
    for (int i = 0; i < system.multipliers(); ++i) {
      if (system.constraint_kind(i) != ConstraintKind::holonomic) {
        r[first + i] = 0;
        continue;
      }
      const double violation = std::abs(r[first + i]) / sizes[i];
      if (!(violation <= worst)) {
        worst = violation;
        worst_row = first + i;
      }
    }
    const bool together = worst <= satisfied || (iteration > 0 && worst <= 1e3 * satisfied && worst >= 0.5 * previous);
    if (together && (iteration == 0 || motion <= relaxed || iteration == iterations)) break;
    if (iteration == iterations || !std::isfinite(worst))
      throw ComputationError(fmt::format("the mechanism cannot be put together: {} stays violated by {:.3g} {}",
                                         system.equation_name(worst_row), r[worst_row],
                                         system.equation_units(worst_row)));
    previous = worst;
    const State still = unstressed(state);
    const TangentWeights weights{1, 0, 0, 1, 1, true};
    linear.try_factor(still, unloaded, weights, nullptr);
    // So little that parts as slender as 1e4 turn rather than bend.
    const VectorX extra = small_diagonal(system, linear, state, 1e-10);
    if (!linear.try_factor(still, unloaded, weights, nullptr, &extra)) linear.throw_singular(state.time);
    system.residual(still, unloaded, elastic);
    r.head(first) = elastic.head(first) - drawn.head(first);
    linear.solve(r, step);
    VectorX dq = step.head(system.dofs());
    // Far from assembled, a full step may overshoot: no node turns by more than this at once.
    double largest_turn = 0;
    motion = 0;
    for (int i = 0; i < system.dofs(); ++i) {
      if (system.kind(i) == Kind::rotation) largest_turn = std::max(largest_turn, std::abs(dq[i]));
      if (system.kind(i) == Kind::translation) motion = std::max(motion, std::abs(dq[i]) / length);
    }
    motion = std::max(motion, largest_turn);
    const double part = largest_turn > most_turn ? most_turn / largest_turn : 1;
    dq *= part;
    const State base = state;
    system.displace(state, base, dq);
    for (const int k : system.algebraic()) state.first_order[k] += part * step[system.dofs() + k];
  }
  if (const std::string wrong = system.wrong_branch(state, environment); !wrong.empty())
    throw ComputationError(
        fmt::format("the mechanism is put together the wrong way round; {}: draw it nearer to where it starts", wrong));
  note_farthest(system, start, state, report.largest_displacement, report.displaced_node);
  for (std::size_t i = 0; i < state.nodes.size(); ++i)
    report.largest_rotation =
        std::max(report.largest_rotation, log_so3(Matrix3(start.nodes[i].R.transpose() * state.nodes[i].R)).norm());
}

void make_velocities_consistent(const System& system, const Environment& environment, State& state,
                                StartReport& report) {
  VectorX v(system.dofs()), a(system.dofs());
  system.get_rates(state, v, a);
  if (system.multipliers() > 0) {
    VectorX rate(system.multipliers()), unused(system.multipliers());
    system.constraint_rates(state, environment, rate, unused);
    VectorX r = VectorX::Zero(system.size()), step(system.size());
    r.tail(system.multipliers()) = rate;
    for (const int multiplier : system.set_aside()) r[system.size() - system.multipliers() + multiplier] = 0;
    LinearStep linear(system);
    factor_mass_saddle(system, environment, state, linear);
    linear.solve(r, step);
    for (int i = 0; i < system.dofs(); ++i)
      if (system.kind(i) == Kind::translation)
        report.velocity_change = std::max(report.velocity_change, std::abs(step[i]));
    v += step.head(system.dofs());
  }
  system.set_rates(state, v, a);
}

namespace {

/// The equations of accelerations, multipliers, first-order rates and algebraic unknowns, positions and velocities
/// being given. All but the algebraic unknowns enter linearly, or nearly so.
class AccelerationEquations {
 public:
  AccelerationEquations(const System& system, const Environment& environment, State& state)
      : system_(system),
        environment_(environment),
        state_(state),
        linear_(system),
        v_(system.dofs()),
        a_(system.dofs()),
        r_(system.size()),
        step_(system.size()),
        begin_(state.first_order),
        size_(system.algebraic().size(), 0.0) {
    system.get_rates(state, v_, a_);
    a_.setZero();
    state.multiplier.setZero();
    state.first_order_rate.setZero();
    system.set_rates(state, v_, a_);
    evaluate();
  }

  void factor() { floor_ = factor_mass_saddle(system_, environment_, state_, linear_); }

  /// The step of Newton's method with the last factors.
  void solve() {
    linear_.solve(r_, step_);
    if (!(floor_.array() > 0).any()) return;
    // Forces that nothing but the floor balances would be accelerations without end. They equal floor times
    // acceleration (to the size of the floor everywhere else): take them out.
    r_.head(system_.dofs()) += floor_.cwiseProduct(step_.head(system_.dofs()));
    linear_.solve(r_, step_);
  }

  void move(double part) {
    const int n = system_.dofs();
    a_ += part * step_.head(n);
    system_.set_rates(state_, v_, a_);
    state_.first_order_rate += part * step_.segment(n, system_.first_orders());
    for (const int k : system_.algebraic()) {
      state_.first_order_rate[k] = 0;
      state_.first_order[k] += part * step_[n + k];
    }
    state_.multiplier += part * step_.tail(system_.multipliers());
  }

  void solve_for_algebraic() {
    constexpr int most = 50;
    constexpr double accurate = 1e-9;  // the step: what is left behind it is its square
    for (int iteration = 0;; ++iteration) {
      measure();
      const double size = size_of_step();
      if (size <= accurate) return move(1);
      if (iteration == most || !std::isfinite(size)) throw_unsolved(iteration);
      shorten(size);
      factor();
      solve();
    }
  }

 private:
  void evaluate() {
    const int m = system_.multipliers();
    VectorX velocity(m), acceleration(m);
    system_.residual(state_, environment_, r_);
    system_.constraint_rates(state_, environment_, velocity, acceleration);
    r_.tail(m) = acceleration;
    for (const int multiplier : system_.set_aside()) r_[system_.size() - m + multiplier] = 0;
  }

  /// What steps of the algebraic unknowns are compared with: their scales, where the search began, where it is. (From
  /// zero, without a scale, the step is no smaller than itself.)
  void measure() {
    for (std::size_t j = 0; j < size_.size(); ++j) {
      const int k = system_.algebraic()[j];
      size_[j] = std::max({std::abs(state_.first_order[k]), std::abs(begin_[k]), system_.scale(system_.dofs() + k)});
      if (size_[j] == 0) size_[j] = std::abs(step_[system_.dofs() + k]);
    }
  }

  double size_of_step() {
    double most = 0;
    for (std::size_t j = 0; j < size_.size(); ++j) {
      const int unknown = system_.dofs() + system_.algebraic()[j];
      if (step_[unknown] == 0) continue;
      const double size = std::abs(step_[unknown]) / size_[j];
      if (size <= most) continue;
      most = size;
      worst_ = unknown;
      if (!std::isfinite(size)) break;
    }
    return most;
  }

  /// Moves by as much of the step as makes the next one, with the same factors, shorter (P. Deuflhard, Newton Methods
  /// for Nonlinear Problems, 2004, 3.3): nothing else compares residuals of different units.
  void shorten(double size) {
    const State base = state_;
    const VectorX a = a_, step = step_;
    for (double part = 1; part > 1e-3; part /= 2) {
      state_ = base;
      a_ = a;
      step_ = step;
      move(part);
      try {
        evaluate();
        solve();
      } catch (const ComputationError&) {
        continue;  // refused by a component
      }
      if (size_of_step() <= (1 - part / 4) * size) break;
    }
    evaluate();
  }

  [[noreturn]] void throw_unsolved(int iterations) {
    evaluate();
    throw ComputationError(
        fmt::format("t = {:.6g} s: no value was found for {} that satisfies its equation; {:.2g} {} are left after {} "
                    "iterations of Newton's method",
                    state_.time, system_.unknown_name(worst_), r_[worst_], system_.equation_units(worst_), iterations));
  }

  const System& system_;
  const Environment& environment_;
  State& state_;
  LinearStep linear_;
  VectorX v_, a_, r_, step_, floor_;
  VectorX begin_;             ///< first-order unknowns
  std::vector<double> size_;  ///< of each algebraic unknown
  int worst_ = 0;
};

}  // namespace

void make_accelerations_consistent(const System& system, const Environment& environment, State& state) {
  AccelerationEquations equations(system, environment, state);
  equations.factor();
  equations.solve();
  if (system.algebraic().empty())
    equations.move(1);
  else
    equations.solve_for_algebraic();
}

StartReport make_consistent(const System& system, const Environment& environment, State& state) {
  StartReport report;
  assemble_positions(system, environment, state, report);
  check_set_aside(system, environment, state);
  check_massless_directions(system, state);
  make_velocities_consistent(system, environment, state, report);
  make_accelerations_consistent(system, environment, state);
  balance_massless(system, environment, state, report);
  return report;
}

}  // namespace bielle::mechanism
