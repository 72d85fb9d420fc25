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
                                StartReport& report, MassSaddle& saddle) {
  VectorX v(system.dofs()), a(system.dofs());
  system.get_rates(state, v, a);
  if (system.multipliers() > 0) {
    VectorX rate(system.multipliers()), unused(system.multipliers());
    system.constraint_rates(state, environment, rate, unused);
    VectorX r = VectorX::Zero(system.size()), step(system.size());
    r.tail(system.multipliers()) = rate;
    system.for_each_idle(state, [&](int k) { r[system.size() - system.multipliers() + k] = 0; });
    saddle.factor(environment, state);
    saddle.solve(r, step);
    for (int i = 0; i < system.dofs(); ++i)
      if (system.kind(i) == Kind::translation)
        report.velocity_change = std::max(report.velocity_change, std::abs(step[i]));
    v += step.head(system.dofs());
    // Impulses -B^T mu work on the way; what moves by itself, B v + c = 0, takes c mu from its drive.
    system.set_rates(state, VectorX::Zero(system.dofs()), a);
    VectorX driven(system.multipliers());
    system.constraint_rates(state, environment, driven, unused);
    report.impulse_work = driven.dot(step.tail(system.multipliers()));
  }
  system.set_rates(state, v, a);
}

StartReport make_consistent(const System& system, const Environment& environment, State& state) {
  StartReport report;
  assemble_positions(system, environment, state, report);
  system.begin_branch(state, environment);
  set_redundant_aside(system, environment, state);
  check_set_aside(system, environment, state);
  check_massless_directions(system, state);
  MassSaddle saddle(system);
  make_velocities_consistent(system, environment, state, report, saddle);
  make_accelerations_consistent(system, environment, state, saddle);
  balance_massless(system, environment, state, report);
  return report;
}

}  // namespace bielle::mechanism
