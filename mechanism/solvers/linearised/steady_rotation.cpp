#include "mechanism/solvers/linearised/steady_rotation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/solvers/linearised/shifted_operator.hpp"
#include "mechanism/solvers/newton/model_length.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

void turn(const System& system, const SteadyRotation& rotation, State& state) {
  State turning = state;
  for (NodeState& node : turning.nodes) {
    node.v = rotation.omega.cross(node.x - rotation.through);
    node.a = rotation.omega.cross(node.v);
    node.Omega = node.R.transpose() * rotation.omega;
    node.Omegadot.setZero();
  }
  turning.amplitude_rate.setZero();
  turning.amplitude_acceleration.setZero();
  VectorX v(system.dofs()), a(system.dofs());
  system.get_rates(turning, v, a);
  system.set_rates(state, v, a);
  state.first_order_rate.setZero();
}

/// Newton's method from the state. @returns whether it has converged
bool settle_at(const System& system, const Environment& environment, const SteadyRotation& rotation, State& state) {
  constexpr int most = 30;
  constexpr double small = 1e-10;  // relative to the mechanism's size, and [rad]: below, the last step ends it
  const double length = model_length(state), rate = rotation.omega.norm();
  const int n = system.dofs() + system.first_orders();
  VectorX r(system.size());
  double before = INFINITY;
  for (int iteration = 0; iteration < most; ++iteration) {
    turn(system, rotation, state);
    system.residual(state, environment, r);
    const LinearisedEquations equations = linearised_equations(system, environment, state, ModeAxes::turning);
    // A little inertia, so that what nothing holds (a free shaft) stays where it is.
    const ShiftedOperator D(equations, 1e-3 * rate);
    if (!D.regular()) return false;
    VectorX right(n + equations.constraints());
    right.head(n) = -r.head(n);
    for (int k = 0; k < equations.constraints(); ++k)
      right[n + k] = -r[n + equations.multiplier[static_cast<std::size_t>(k)]];
    const VectorX step = D.solve(right.cast<std::complex<double>>()).real();
    if (!step.allFinite()) return false;
    double size = 0;
    for (int i = 0; i < system.dofs(); ++i)
      if (system.kind(i) != Kind::amplitude)
        size = std::max(size, std::abs(step[i]) / (system.kind(i) == Kind::translation ? length : 1));
    constexpr double farthest = 0.5;
    if (!(size < farthest) || (iteration > 5 && size > before)) return false;
    system.displace(state, State(state), step.head(system.dofs()));
    state.first_order += step.segment(system.dofs(), system.first_orders());
    for (int k = 0; k < equations.constraints(); ++k)
      state.multiplier[equations.multiplier[static_cast<std::size_t>(k)]] += step[n + k];
    if (size < small) {
      turn(system, rotation, state);
      return true;
    }
    before = size;
  }
  return false;
}

/// What keeps the mechanism from turning as a whole.
void check_turns(const System& system, const Environment& environment, const SteadyRotation& rotation,
                 const State& state) {
  const double rate = rotation.omega.norm(), length = model_length(state);
  VectorX velocity(system.multipliers()), unused(system.multipliers());
  system.constraint_rates(state, environment, velocity, unused);
  system.for_each_idle(state, [&](int k) { velocity[k] = 0; });
  const VectorX sizes = constraint_sizes(system, environment, state);
  constexpr double agrees = 1e-6;
  for (int k = 0; k < system.multipliers(); ++k)
    if (std::abs(velocity[k]) > agrees * rate * sizes[k])
      throw ComputationError(fmt::format("the mechanism cannot turn as a whole: {} does not let it ({:.3g} {}/s)",
                                         system.equation_name(system.size() - system.multipliers() + k), velocity[k],
                                         system.equation_units(system.size() - system.multipliers() + k)));
  for (std::size_t k = 0; k < state.nodes.size(); ++k) {
    const NodeState& node = state.nodes[k];
    const NodeFreedom& freedom = system.kinematics().freedom(static_cast<int>(k));
    if (freedom.count == 0 || system.kinematics().carry(static_cast<int>(k))) continue;
    const double gap = (node.v - rotation.omega.cross(node.x - rotation.through)).norm() / length +
                       (node.R * node.Omega - rotation.omega).norm();
    if (gap > agrees * rate)
      throw ComputationError(fmt::format(
          "the mechanism cannot turn as a whole: node '{}' is held in directions in which it would have to move",
          system.model().node(static_cast<int>(k)).name));
  }
}

}  // namespace

void settle_in_rotation(const System& system, const Environment& environment, const SteadyRotation& rotation,
                        State& state) {
  const State begin = state;
  for (int steps = 1; steps <= 16; steps *= 4) {
    state = begin;
    bool good = true;
    for (int k = 1; k <= steps && good; ++k) {
      SteadyRotation part = rotation;
      part.omega *= std::sqrt(static_cast<double>(k) / steps);
      try {
        good = settle_at(system, environment, part, state);
      } catch (const ComputationError&) {
        good = false;  // a wild iterate that a component refuses
      }
    }
    if (!good) continue;
    check_turns(system, environment, rotation, state);
    return;
  }
  throw ComputationError(
      fmt::format("no equilibrium in steady rotation at {:.6g} rad/s was found", rotation.omega.norm()));
}

}  // namespace bielle::mechanism
