#include "mechanism/solvers/start/sought_accelerations.hpp"

#include <limits>

#include <fmt/format.h>

#include "mechanism/solvers/start/consistent_accelerations.hpp"

namespace bielle::mechanism {
namespace {

/// Returns the change of the supports' forces due to a step of accelerations and multipliers, on which they depend
/// linearly.
VectorX answer_of_accelerations(const SoughtEfforts& efforts, const Environment& environment, const State& state,
                                const VectorX& step) {
  const System& system = efforts.system();
  VectorX v(system.dofs()), a(system.dofs());
  system.get_rates(state, v, a);
  State moved = state;
  system.set_rates(moved, v, a + step.head(system.dofs()));
  moved.multiplier += step.tail(system.multipliers());
  return efforts.along(state, efforts.reactions(environment, moved)) -
         efforts.along(state, efforts.reactions(environment, state));
}

}  // namespace

void find_sought_efforts(const SoughtEfforts& efforts, const Environment& environment, State& state,
                         KktMatrix& saddle) {
  if (!efforts.any()) return;
  constexpr int most = 30;  // friction that depends on reactions is nonlinear; otherwise the first solution is exact
  const System& system = efforts.system();
  EffortResponse response;
  VectorX r(system.size());
  ResidualScale scale;
  double before = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most; ++k) {
    const VectorX forces = efforts.along(state, efforts.reactions(environment, state));
    system.residual(state, environment, r, &scale);
    const double ratio = efforts.ratio(forces, scale);
    if (k > 0 && (ratio <= SoughtEfforts::accurate || (ratio <= SoughtEfforts::rounding && ratio > 0.5 * before)))
      return;
    before = ratio;
    if (k == 0) {
      if (!saddle.serves()) saddle.factor(environment, state);
      response.linearise(
          efforts, environment, state, [&](const VectorX& load, VectorX& step) { saddle.solve(load, step); },
          [&](const VectorX& step) { return answer_of_accelerations(efforts, environment, state, step); });
    }
    efforts.set(state, efforts.values(state) + response.change(forces));
    make_accelerations_consistent(system, environment, state, saddle);
  }
  throw ComputationError(fmt::format(
      "t = {:.6g} s: the sought efforts do not settle: forces that depend on reactions (friction) change with them",
      state.time));
}

}  // namespace bielle::mechanism
