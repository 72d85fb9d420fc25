#include "mechanism/solvers/consistent_start.hpp"

#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/redundancy.hpp"

namespace bielle::mechanism {
namespace {

double model_size(const State& state) {
  double size = 0;
  for (const NodeState& node : state.nodes) size = std::max(size, node.x.norm());
  return size > 0 ? size : 1;
}

/// Adds a fraction of the mean diagonal of each kind of dof: regular where a dof has no mass or stiffness of its own.
VectorX small_diagonal(const System& system, const LinearStep& linear, double fraction) {
  std::array<double, kind_count> sum{}, count{};
  for (int i = 0; i < system.dofs(); ++i) {
    const auto kind = static_cast<std::size_t>(system.kind(i));
    sum[kind] += std::abs(linear.diagonal(i));
    count[kind] += 1;
  }
  VectorX diagonal(system.dofs());
  for (int i = 0; i < system.dofs(); ++i) {
    const auto kind = static_cast<std::size_t>(system.kind(i));
    diagonal[i] = fraction * (sum[kind] > 0 ? sum[kind] / count[kind] : 1.0);
  }
  return diagonal;
}

}  // namespace

void factor_mass_saddle(const System& system, const Environment& environment, const State& state, LinearStep& linear) {
  const TangentWeights weights{0, 0, 1, 1, 1, true};
  if (linear.try_factor(state, environment, weights, nullptr)) return;
  // A dof without mass, stiffness, damping and constraint has no equation at all.
  linear.try_factor(state, environment, TangentWeights{1, 1, 1, 1, 1}, nullptr);
  VectorX sums(system.size());
  linear.row_sums(VectorX::Ones(system.size()), sums);
  for (int i = 0; i < system.dofs(); ++i)
    if (sums[i] == 0)
      throw ComputationError(fmt::format("{}: it has no mass, and nothing holds it", system.unknown_name(i)));
  // Massless dofs that constraints hold together: any small mass gives the same multipliers to its own size.
  constexpr double floor = 1e-12;
  const VectorX extra = small_diagonal(system, linear, floor);
  if (!linear.try_factor(state, environment, weights, nullptr, &extra)) linear.throw_singular(state.time);
}

void assemble_positions(const System& system, const Environment& environment, State& state, StartReport& report) {
  if (system.multipliers() == 0) return;
  const int first = system.size() - system.multipliers();
  const double size = model_size(state);
  // Lengths beside the model's size, angles beside one radian: the same number for both serves.
  constexpr double satisfied = 1e-13;
  constexpr int iterations = 50;
  LinearStep linear(system);
  VectorX r(system.size()), step(system.size());
  const State start = state;
  double previous = 0;
  for (int iteration = 0;; ++iteration) {
    system.residual(state, environment, r);
    double worst = 0;
    int worst_row = -1;
    for (int i = 0; i < system.multipliers(); ++i) {
      if (system.constraint_kind(i) != ConstraintKind::holonomic) {
        r[first + i] = 0;
        continue;
      }
      const double violation = std::abs(r[first + i]) / (system.equation_units(first + i) == "m" ? size : 1.0);
      if (!(violation <= worst)) {
        worst = violation;
        worst_row = first + i;
      }
    }
    if (worst <= satisfied || (iteration > 0 && worst <= 1e3 * satisfied && worst >= 0.5 * previous)) break;
    if (iteration == iterations || !std::isfinite(worst))
      throw ComputationError(fmt::format("the mechanism cannot be put together: {} stays violated by {:.3g} {}",
                                         system.equation_name(worst_row), r[worst_row],
                                         system.equation_units(worst_row)));
    previous = worst;
    const TangentWeights weights{1, 0, 0, 1, 1, true};
    Environment unloaded;
    unloaded.load_factor = environment.load_factor;
    State unstressed = state;
    unstressed.multiplier.setZero();
    linear.try_factor(unstressed, unloaded, weights, nullptr);
    const VectorX extra = small_diagonal(system, linear, 1e-4);
    if (!linear.try_factor(unstressed, unloaded, weights, nullptr, &extra)) linear.throw_singular(state.time);
    r.head(first).setZero();
    linear.solve(r, step);
    VectorX dq = step.head(system.dofs());
    // Far from assembled, a full step may overshoot: no node turns by more than a third of a turn at once.
    double largest_turn = 0;
    for (int i = 0; i < system.dofs(); ++i)
      if (system.kind(i) == Kind::rotation) largest_turn = std::max(largest_turn, std::abs(dq[i]));
    if (largest_turn > 1) dq /= largest_turn;
    const State base = state;
    system.displace(state, base, dq);
  }
  for (std::size_t i = 0; i < state.nodes.size(); ++i) {
    const double distance = (state.nodes[i].x - start.nodes[i].x).norm();
    if (distance > report.largest_displacement) {
      report.largest_displacement = distance;
      report.displaced_node = system.model().node(static_cast<int>(i)).name;
    }
    report.largest_rotation =
        std::max(report.largest_rotation, log_so3(Matrix3(start.nodes[i].R.transpose() * state.nodes[i].R)).norm());
  }
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

void make_accelerations_consistent(const System& system, const Environment& environment, State& state) {
  const int n = system.dofs(), y = system.first_orders(), m = system.multipliers();
  VectorX v(n), a(n);
  system.get_rates(state, v, a);
  state.multiplier.setZero();
  state.first_order_rate.setZero();
  system.set_rates(state, v, VectorX::Zero(n));
  VectorX r(system.size()), velocity(m), acceleration(m), step(system.size());
  system.residual(state, environment, r);
  system.constraint_rates(state, environment, velocity, acceleration);
  r.tail(m) = acceleration;
  for (const int multiplier : system.set_aside()) r[n + y + multiplier] = 0;
  LinearStep linear(system);
  factor_mass_saddle(system, environment, state, linear);
  linear.solve(r, step);
  system.set_rates(state, v, step.head(n));
  state.first_order_rate = step.segment(n, y);
  state.multiplier = step.tail(m);
}

StartReport make_consistent(const System& system, const Environment& environment, State& state) {
  StartReport report;
  assemble_positions(system, environment, state, report);
  check_set_aside(system, environment, state);
  make_velocities_consistent(system, environment, state, report);
  make_accelerations_consistent(system, environment, state);
  return report;
}

}  // namespace bielle::mechanism
