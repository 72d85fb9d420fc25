#include "mechanism/solvers/statics/statics.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "mechanism/solvers/start/assemble_positions.hpp"
#include "mechanism/solvers/statics/equilibrium.hpp"
#include "mechanism/solvers/statics/held_states.hpp"

namespace bielle::mechanism {

void solve_statics(const System& system, const Environment& environment, const LoadSteps& steps,
                   const NewtonOptions& options, State& state,
                   const std::function<void(const State&, double, int)>& record) {
  const LoadRamp ramp(system, environment, steps.start);
  ramp.set_off(state);
  begin_states(system, ramp.environment(1), state);
  Equilibrium equilibrium(ramp, options);
  const double begin = ramp.begin();
  // Parts of the way from there to the full load.
  const double first_part = begin == 1 ? 1 : steps.count > 0 ? 1.0 / steps.count : 0.1;
  const double largest_part = steps.count > 0 ? first_part : 1, least_part = first_part / 1024;
  double made = 0, part = first_part;
  while (made < 1) {
    const double end = made + part > 1 - 1e-12 ? 1 : made + part;
    const double factor = end == 1 ? 1 : begin + end * (1 - begin);
    int iterations = equilibrium.find(factor, state);
    if (iterations < 0 && begin == 1) iterations = equilibrium.relax(factor, state);
    if (iterations < 0) {
      part /= 2;
      if (part < least_part || begin == 1)
        throw ComputationError(fmt::format("statics: no equilibrium found at load factor {:.6g} (increment {:.3g}): {}",
                                           factor, (end - made) * (1 - begin), equilibrium.why()));
      continue;
    }
    equilibrium.accept(factor, state);
    made = end;
    if (record) record(state, factor, iterations);
    if (iterations <= 5) part = std::min(largest_part, 2 * part);
  }
}

namespace {

/// The unknown that moves most where nothing resists; none where everything resists.
std::optional<int> loose_unknown(const System& system, const Environment& environment, const State& state) {
  LinearStep linear(system);
  TangentWeights weights;
  weights.acceleration_level = true;
  if (!linear.try_factor(state, environment, weights, nullptr)) return linear.singular_unknown();
  if (!linear.nearly_singular()) return {};
  // A solution for any forces lies along what is loose.
  VectorX motion(system.size());
  linear.solve(VectorX::LinSpaced(system.size(), 1, 2), motion);
  Eigen::Index most = 0;
  motion.head(system.dofs()).cwiseAbs().maxCoeff(&most);
  return static_cast<int>(most);
}

void relax(const System& system, const Environment& environment, const NewtonOptions& options, State& state) {
  const LoadRamp ramp(system, environment, {1, 1});
  ramp.set_off(state);
  begin_states(system, ramp.environment(1), state);
  Equilibrium equilibrium(ramp, options);
  if (equilibrium.relax(1, state) < 0)
    throw ComputationError(fmt::format(
        "static equilibrium at the start: none was found (what nothing holds has none); {}", equilibrium.why()));
  equilibrium.accept(1, state);
}

}  // namespace

void settle(const System& system, const Environment& of_motion, const NewtonOptions& options, State& state,
            StartReport& report) {
  Environment environment = of_motion;
  environment.statics = true;
  assemble_positions(system, environment, state, report);
  VectorX v(system.dofs()), unused(system.dofs());
  system.get_rates(state, v, unused);
  const State assembled = state;
  try {
    solve_statics(system, environment, LoadSteps(1, {0, 1}), options, state);
  } catch (const ComputationError&) {
    state = assembled;
    relax(system, environment, options, state);
  }
  if (const auto loose = loose_unknown(system, environment, state))
    throw ComputationError(fmt::format("static equilibrium at the start: it is not unique: {} meets no resistance",
                                       *loose >= 0 ? system.unknown_name(*loose) : "an unknown"));
  system.set_rates(state, v, VectorX::Zero(system.dofs()));
  note_farthest(system, assembled, state, report.settled, report.settled_node);
  report.held = held_names(system, state);
}

}  // namespace bielle::mechanism
