#include "mechanism/solvers/statics.hpp"

#include <string>

#include <fmt/format.h>

#include "mechanism/solvers/redundancy.hpp"

namespace bielle::mechanism {
namespace {

/// Newton's method at a fixed load. Returns the iterations, or -1 with the state as it was.
/// @throws ComputationError from components and from a singular tangent
int equilibrate(const System& system, const Environment& environment, const NewtonOptions& options, LinearStep& linear,
                Convergence& convergence, State& state) {
  const State start = state;
  VectorX r(system.size()), delta(system.size());
  ResidualScale scale;
  TangentWeights weights;
  weights.acceleration_level = true;
  for (int iteration = 0;; ++iteration) {
    system.residual(state, environment, r, &scale);
    // Nothing moves: what relates velocities keeps things where they are.
    for (int i = 0; i < system.multipliers(); ++i)
      if (system.constraint_kind(i) == ConstraintKind::nonholonomic) r[system.size() - system.multipliers() + i] = 0;
    if (iteration > 0 && convergence.reached(r, scale)) return iteration;
    if (iteration == options.iterations || !r.allFinite()) {
      convergence.reached(r, scale);
      state = start;
      return -1;
    }
    linear.factor(state, environment, weights, nullptr);
    convergence.measure_rounding(linear, state);
    linear.solve(r, delta);
    const State base = state;
    system.displace(state, base, delta.head(system.dofs()));
    state.first_order += delta.segment(system.dofs(), system.first_orders());
    state.multiplier += delta.tail(system.multipliers());
  }
}

}  // namespace

void solve_statics(const System& system, const Environment& environment, int steps, const NewtonOptions& options,
                   State& state, const std::function<void(const State&, double, int)>& record) {
  const VectorX zero = VectorX::Zero(system.dofs());
  system.set_rates(state, zero, zero);
  state.first_order_rate.setZero();
  LinearStep linear(system);
  Convergence convergence(system, options);
  const double first_increment = 1.0 / steps, least_increment = first_increment / 1024;
  double factor = 0, increment = first_increment;
  while (factor < 1) {
    const double target = factor + increment > 1 - 1e-12 ? 1 : factor + increment;
    Environment loaded = environment;
    loaded.load_factor = target;
    loaded.gravity = target * environment.gravity;
    // A component that refuses a wild iterate (a beam whose ends turn too far) makes the attempt fail, not the
    // analysis.
    std::string refusal;
    int iterations = -1;
    const State before = state;
    try {
      iterations = equilibrate(system, loaded, options, linear, convergence, state);
    } catch (const ComputationError& error) {
      refusal = error.what();
      state = before;
    }
    if (iterations < 0) {
      increment /= 2;
      if (increment < least_increment && !refusal.empty()) throw ComputationError(refusal);
      if (increment < least_increment)
        throw ComputationError(fmt::format(
            "statics: Newton did not converge at load factor {:.6g} (increment {:.3g}); largest residual: {}", target,
            increment * 2, convergence.worst()));
      continue;
    }
    check_set_aside(system, loaded, state);
    factor = target;
    system.accept(state, loaded);
    if (record) record(state, factor, iterations);
    if (iterations <= 5) increment = std::min(first_increment, 2 * increment);
  }
}

}  // namespace bielle::mechanism
